// SPDX-License-Identifier: BSD-3-Clause
// Meshes that tests make for themselves: always the same on every machine.
#ifndef meshopt_Testing_TestMeshes_h
#define meshopt_Testing_TestMeshes_h

#include "EulerCharacteristic.h"
#include "Mesh/CavityFit.h"
#include "Mesh/SimplexMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace meshopt
{
/// For tests that are the same in 2D and 3D.
template <int D>
struct TestDimension
{
  static constexpr int dimension = D;
};
using TestDimensions = ::testing::Types<TestDimension<2>, TestDimension<3>>;

/// Uniform in [-1, 1]; the same numbers with every standard library.
class TestRandom
{
public:
  explicit TestRandom(unsigned seed)
    : engine_(seed)
  {
  }
  double operator()() { return this->engine_() / 2147483647.5 - 1.0; }

private:
  std::mt19937 engine_;
};

/// That of the live cells; the adjacency, which may be wrong, is not used.
template <int D>
long eulerCharacteristic(const SimplexMesh<D>& mesh)
{
  std::vector<Simplex<D>> cells;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      cells.push_back(mesh.nodes(c));
    }
  }
  return eulerCharacteristic<D>(cells);
}

/// CavityFit for a single question.
template <int D>
bool fillsCavity(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells, const KeptChange<D>* change = nullptr)
{
  CavityFit<D> fit;
  fit.load(mesh, cavity, cells);
  return fit.fills(change);
}

template <int D>
bool meetsOthers(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells, const std::vector<std::uint8_t>& pinched)
{
  CavityFit<D> fit;
  fit.load(mesh, cavity, cells);
  return fit.meetsOthers(pinched);
}

/// The unit square (2 triangles a square) or cube (6 tetrahedra a cube) of n^D boxes; interior
/// points are displaced by up to `jitter` box sizes in each coordinate. Beyond some .3 elements get
/// inverted.
template <int D>
MeshInput<D> jitteredGrid(int n, double jitter, unsigned seed = 1)
{
  MeshInput<D> in;
  TestRandom random(seed);
  const int nz = D == 3 ? n : 0;
  for (int k = 0; k <= nz; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        const int at[3] = { i, j, k };
        bool inside = true;
        Vec<D> x;
        for (int d = 0; d < D; ++d)
        {
          x[d] = at[d] / double(n);
          inside = inside && at[d] > 0 && at[d] < n;
        }
        for (int d = 0; d < D && inside; ++d)
        {
          x[d] += jitter / n * random();
        }
        in.points.push_back(x);
      }
    }
  }
  const auto id = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  // Kuhn's triangulation: one simplex per order in which the coordinates grow.
  for (int k = 0; k < std::max(nz, 1); ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        std::vector<int> order(D);
        for (int d = 0; d < D; ++d)
        {
          order[d] = d;
        }
        do
        {
          int at[3] = { i, j, k };
          Simplex<D> cell;
          cell[0] = id(at[0], at[1], at[2]);
          int inversions = 0;
          for (int d = 0; d < D; ++d)
          {
            ++at[order[d]];
            cell[d + 1] = id(at[0], at[1], at[2]);
            for (int e = 0; e < d; ++e)
            {
              inversions += order[e] > order[d] ? 1 : 0;
            }
          }
          if (inversions % 2)
          {
            std::swap(cell[D - 1], cell[D]);
          }
          in.cells.push_back(cell);
        } while (std::next_permutation(order.begin(), order.end()));
      }
    }
  }
  return in;
}

/// Gives the cells whose centre has x < 1/2 region 0, the others region 1.
template <int D>
void splitRegions(MeshInput<D>& in)
{
  in.regions.clear();
  for (const Simplex<D>& cell : in.cells)
  {
    double x = 0.0;
    for (Index p : cell)
    {
      x += in.points[p][0] / (D + 1);
    }
    in.regions.push_back(x < 0.5 ? 0 : 1);
  }
}

/// The corner of the unit square or cube.
template <int D>
MeshInput<D> oneCell()
{
  MeshInput<D> in;
  in.points.assign(D + 1, Vec<D>::Zero());
  Simplex<D> cell;
  for (int i = 0; i <= D; ++i)
  {
    cell[i] = i;
    if (i > 0)
    {
      in.points[i][i - 1] = 1.0;
    }
  }
  in.cells = { cell };
  return in;
}

/// n tetrahedra around the edge (0, 1); the last `missing` ones are left out.
inline MeshInput<3> ringOf(int n, int missing = 0)
{
  MeshInput<3> in;
  in.points = { { 0, 0, -1 }, { 0, 0, 1 } };
  for (int k = 0; k < n; ++k)
  {
    const double a = 2.0 * M_PI * k / n;
    in.points.emplace_back(std::cos(a), std::sin(a), 0.0);
    if (k + missing < n)
    {
      in.cells.push_back({ 0, 1, 2 + k, 2 + (k + 1) % n });
    }
  }
  return in;
}

inline std::vector<Index> sorted(std::vector<Index> v)
{
  std::sort(v.begin(), v.end());
  return v;
}

template <int D>
SimplexMesh<D> buildMesh(const MeshInput<D>& in)
{
  SimplexMesh<D> mesh;
  const auto error = SimplexMesh<D>::build(in, mesh);
  EXPECT_FALSE(error) << (error ? error->message : "");
  return mesh;
}

/// Qualities of the live cells, ascending.
template <int D>
std::vector<double> sortedQualities(const SimplexMesh<D>& mesh)
{
  std::vector<double> q;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      q.push_back(mesh.quality(c));
    }
  }
  std::sort(q.begin(), q.end());
  return q;
}

/// True if sorted vector b is lexicographically above a; a missing entry counts as the best of all.
inline bool isAbove(const std::vector<double>& b, const std::vector<double>& a)
{
  for (std::size_t k = 0; k < std::max(a.size(), b.size()); ++k)
  {
    const double best = std::numeric_limits<double>::infinity();
    const double x = k < a.size() ? a[k] : best, y = k < b.size() ? b[k] : best;
    if (x != y)
    {
      return y > x;
    }
  }
  return false;
}

/// Coordinates of the kept facets, with the regions on both sides: what must stay, bit for bit.
template <int D>
std::multiset<std::vector<double>> keptFacets(const SimplexMesh<D>& mesh)
{
  std::multiset<std::vector<double>> all;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    for (int i = 0; i <= D && mesh.isAlive(c); ++i)
    {
      if (!mesh.isKept(c, i))
      {
        continue;
      }
      std::vector<std::vector<double>> rows;
      for (Index p : mesh.facet(c, i))
      {
        rows.emplace_back(mesh.point(p).data(), mesh.point(p).data() + D);
      }
      std::sort(rows.begin(), rows.end());
      std::vector<double> flat{ double(mesh.region(c)) };
      for (const auto& row : rows)
      {
        flat.insert(flat.end(), row.begin(), row.end());
      }
      all.insert(flat);
    }
  }
  return all;
}

/// Everything that makes up the mesh, to compare two runs.
template <int D>
struct MeshBits
{
  std::vector<double> coordinates;
  std::vector<Index> ids;
  bool operator==(const MeshBits& other) const
  {
    return this->coordinates == other.coordinates && this->ids == other.ids;
  }
};

template <int D>
MeshBits<D> bitsOf(const SimplexMesh<D>& mesh)
{
  MeshBits<D> bits;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c))
    {
      bits.ids.insert(bits.ids.end(), mesh.nodes(c).begin(), mesh.nodes(c).end());
      bits.ids.push_back(mesh.parent(c));
    }
  }
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    for (int d = 0; d < D && mesh.isPointAlive(p); ++d)
    {
      bits.coordinates.push_back(mesh.point(p)[d]);
    }
  }
  return bits;
}

template <int D>
void expectSound(const SimplexMesh<D>& mesh, bool positive = true)
{
  for (const std::string& fault : mesh.audit(positive))
  {
    ADD_FAILURE() << fault;
  }
}
}

#endif
