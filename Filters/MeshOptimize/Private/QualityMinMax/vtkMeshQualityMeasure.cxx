// SPDX-License-Identifier: BSD-3-Clause
// Measures cells in chunks of one length, which are merged in their order: figures have the same
// bits for any number of threads.
#include "QualityMinMax/vtkMeshQualityMeasure.h"

#include "Metric/TensorFunctions.h"
#include "Quality/ElementQuality.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>

namespace vtkMeshQualityBridge
{
namespace
{

using meshopt::Corners;
using meshopt::ElementMetric;
using meshopt::Vec;

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

/**
 * The functor of the same measure for triangles.
 */
template <template <int> class Shape>
Shape<2> ForTriangles(const Shape<3>&)
{
  return {};
}

/**
 * The triangle in its own plane; positive unless it is flat.
 */
Corners<2> Unfold(const Corners<3>& x)
{
  const Vec<3> a = x[1] - x[0], b = x[2] - x[0];
  const double l = a.norm();
  // Two corners at one place: flat, wherever the third is.
  if (l == 0.0)
  {
    return { Vec<2>(0.0, 0.0), Vec<2>(0.0, 0.0), Vec<2>(b.norm(), 0.0) };
  }
  return { Vec<2>(0.0, 0.0), Vec<2>(l, 0.0), Vec<2>(a.dot(b) / l, a.cross(b).norm() / l) };
}

/**
 * Quality (2.2) of single cells.
 */
template <class Shape>
class Evaluator
{
public:
  Evaluator(const Grid& grid, const Options& options)
    : Mesh(grid)
    , DesiredSize(options.DesiredSize)
    , IsPlain(options.Beta == 0.0 && !grid.HasMetric())
  {
    this->Solid.beta = options.Beta;
    this->Flat.beta = options.Beta;
  }

  double operator()(vtkIdType cell, Kind kind) const
  {
    const double q = kind == Kind::Tetrahedron ? this->Tetrahedron(cell) : this->Triangle(cell);
    // What is not finite cannot be compared, and is counted apart.
    return std::isfinite(q) ? q : NotANumber;
  }

private:
  double Tetrahedron(vtkIdType cell) const
  {
    vtkIdType ids[4];
    if (!this->Mesh.GetCorners(cell, 4, ids))
    {
      return NotANumber;
    }
    const Corners<3> x = { this->Mesh.GetPoint(ids[0]), this->Mesh.GetPoint(ids[1]),
      this->Mesh.GetPoint(ids[2]), this->Mesh.GetPoint(ids[3]) };
    // The usual case, without metric and size factor.
    if (this->IsPlain)
    {
      return Shape::value(x);
    }
    return ValueIn(this->MetricOf<3>(ids), this->Solid, x);
  }

  /// NaN for a ghost without a usable size: otherwise only its shape would count.
  template <int D, class Quality>
  static double ValueIn(const ElementMetric<D>& metric, const Quality& quality, const Corners<D>& x)
  {
    return std::isnan(metric.desiredSize) ? NotANumber : quality.value(x, metric);
  }

  double Triangle(vtkIdType cell) const
  {
    vtkIdType ids[3];
    if (!this->Mesh.GetCorners(cell, 3, ids))
    {
      return NotANumber;
    }
    Corners<3> x = { this->Mesh.GetPoint(ids[0]), this->Mesh.GetPoint(ids[1]),
      this->Mesh.GetPoint(ids[2]), Vec<3>::Zero() };
    if (this->Mesh.IsFlat())
    {
      const vtkMeshBridge::Frame<2>& frame = this->Mesh.GetFrame();
      const Corners<2> y = { frame.ToCore(x[0].data()), frame.ToCore(x[1].data()),
        frame.ToCore(x[2].data()) };
      // NaN also if only the coordinate across the plane is not finite.
      const double finite = 0.0 * (x[0].sum() + x[1].sum() + x[2].sum());
      return ValueIn(this->MetricOf<2>(ids), this->Flat, y) + finite;
    }
    ElementMetric<2> size;
    // Out of a plane the metric is taken in space, and the triangle is laid flat after that.
    if (!this->IsPlain)
    {
      const ElementMetric<3> metric = this->MetricOf<3>(ids, 3);
      size.desiredSize = metric.desiredSize;
      // The first corner last: the others are taken relative to it.
      for (int i = 2; !metric.euclidean && i >= 0; --i)
      {
        x[i] = metric.map * (x[i] - x[0]);
      }
    }
    return ValueIn(size, this->Flat, Unfold(x));
  }

  /// In the metric of the n nodes, the same as NodalMetric::element().
  template <int D>
  ElementMetric<D> MetricOf(const vtkIdType* ids, int n = D + 1) const
  {
    ElementMetric<D> metric;
    metric.desiredSize = this->DesiredSize;
    if (!this->Mesh.GetLogSizes().empty())
    {
      double sum = 0.0;
      for (int k = 0; k < n; ++k)
      {
        sum += this->Mesh.GetLogSizes()[ids[k]];
      }
      metric.desiredSize = std::exp(sum / n);
    }
    const std::vector<meshopt::Tensor<D>>& logs = this->Mesh.template GetLogTensors<D>();
    if (!logs.empty())
    {
      meshopt::Tensor<D> sum = meshopt::Tensor<D>::Zero();
      for (int k = 0; k < n; ++k)
      {
        sum += logs[ids[k]];
      }
      // Means of logarithms, as of all tensors here. Half of it: the map is the root.
      metric.euclidean = false;
      metric.map = meshopt::exponential<D>((sum * (0.5 / n)).eval());
    }
    return metric;
  }

  using Shape2 = decltype(ForTriangles(Shape{}));
  const Grid& Mesh;
  double DesiredSize;
  bool IsPlain;
  meshopt::ElementQuality<3, Shape> Solid;
  meshopt::ElementQuality<2, Shape2> Flat;
};

/**
 * Sums of one chunk of cells.
 */
struct Chunk
{
  meshopt::QualityStatistics Quality;
  std::int64_t OtherCells = 0;
  std::int64_t GhostSimplices = 0;
  std::map<int, Sums> Regions;
  std::vector<meshopt::WorstElement> Worst;
};

/**
 * Measures the cells [begin, end) and adds them up. Ghosts are measured, but do not count.
 */
template <class Shape>
void MeasureChunk(const Grid& grid, const Evaluator<Shape>& evaluate, std::size_t worst,
  std::int64_t part, vtkIdType begin, vtkIdType end, double* quality, Chunk& chunk)
{
  // Collected first, since statistics of an array are faster than those of single values.
  std::array<double, meshopt::StatisticsChunk> counted;
  std::int64_t n = 0;
  meshopt::WorstElements worstCells(worst);
  for (vtkIdType c = begin; c < end; ++c)
  {
    const Kind kind = grid.GetKind(c);
    quality[c] = kind == Kind::Other ? NotANumber : evaluate(c, kind);
    if (grid.IsGhost(c))
    {
      chunk.GhostSimplices += kind == Kind::Other ? 0 : 1;
      continue;
    }
    if (grid.HasRegions())
    {
      // By rank of the region among those of this grid; names come when chunks are merged.
      Sums& sums = chunk.Regions[grid.GetRegion(c)];
      sums.OtherCells += kind == Kind::Other ? 1 : 0;
      if (kind != Kind::Other)
      {
        sums.Quality.add(quality[c]);
      }
    }
    if (kind == Kind::Other)
    {
      ++chunk.OtherCells;
      continue;
    }
    counted[n++] = quality[c];
    worstCells.add({ quality[c], part, c });
  }
  chunk.Quality.add(counted.data(), n);
  chunk.Worst = worstCells.sorted();
}

template <class Shape>
std::vector<Chunk> MeasureChunks(
  const Grid& grid, const Options& options, std::int64_t part, double* quality)
{
  // Chunks of one length, added up in their order: the same bits for any number of threads.
  const vtkIdType length = meshopt::StatisticsChunk;
  const vtkIdType n = grid.GetNumberOfCells();
  std::vector<Chunk> chunks((n + length - 1) / length);
  const Evaluator<Shape> evaluate(grid, options);
  vtkSMPTools::For(0, static_cast<vtkIdType>(chunks.size()), 4,
    [&](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType k = first; k < last; ++k)
      {
        MeasureChunk(grid, evaluate, options.NumberOfWorstCells, part, k * length,
          std::min(n, (k + 1) * length), quality, chunks[k]);
      }
    });
  return chunks;
}

} // namespace

//------------------------------------------------------------------------------
void Sums::Merge(const Sums& other)
{
  this->Quality.merge(other.Quality);
  this->OtherCells += other.OtherCells;
  this->Bound = std::min(this->Bound, other.Bound);
  this->CappedCells += other.CappedCells;
}

//------------------------------------------------------------------------------
void Figures::Merge(const Figures& other)
{
  this->Total.Merge(other.Total);
  for (const auto& region : other.Regions)
  {
    this->Regions[region.first].Merge(region.second);
  }
  this->Worst.merge(other.Worst);
  this->GhostSimplices += other.GhostSimplices;
  this->HasTetrahedra |= other.HasTetrahedra;
  this->HasTriangles |= other.HasTriangles;
}

//------------------------------------------------------------------------------
Figures MeasureGrid(const Grid& grid, const Options& options, std::int64_t part, double* quality)
{
  const std::vector<Chunk> chunks = meshopt::dispatch<3>(options.Measure,
    [&](auto shape) { return MeasureChunks<decltype(shape)>(grid, options, part, quality); });
  Figures figures(options.NumberOfWorstCells);
  figures.HasTetrahedra = grid.HasTetrahedra();
  figures.HasTriangles = grid.HasTriangles();
  for (const Chunk& chunk : chunks)
  {
    figures.Total.Quality.merge(chunk.Quality);
    figures.Total.OtherCells += chunk.OtherCells;
    figures.GhostSimplices += chunk.GhostSimplices;
    for (const auto& region : chunk.Regions)
    {
      figures.Regions[grid.GetRegions()[region.first]].Merge(region.second);
    }
    for (const meshopt::WorstElement& e : chunk.Worst)
    {
      figures.Worst.add(e);
    }
  }
  return figures;
}

} // namespace vtkMeshQualityBridge
