// SPDX-License-Identifier: BSD-3-Clause
/// @file WideInsertion.h
/// Inserts a node far from a cell that nothing near it helps: flat cells along an edge of the
/// surface lie on each other in layers, and only a cavity that takes in all of them gains. For the
/// few worst cells while they are far below their bound (Judge::setWide()): most that is bad about
/// a mesh can be changed from nearby, at a hundredth of the cost.
#ifndef meshopt_Operations_WideInsertion_h
#define meshopt_Operations_WideInsertion_h

#include "Operations/NodeInsertion.h"

#include <algorithm>
#include <cmath>

namespace meshopt
{
template <int D, class Shape>
class WideInsertion
{
public:
  static constexpr int level = Level::LongLookAhead;
  static constexpr bool addsCells = false; // mostly fewer; else the judge asks the budget
  static bool isOn(const Switches& switches) { return switches.insertNodes; }

  bool improve(Judge<D, Shape>& judge, Index t, int)
  {
    if (judge.wide() == None)
    {
      return false;
    }
    const double side = std::cbrt(judge.mesh().numberOfCellSlots());
    this->mostCells_ = static_cast<int>(
      std::clamp<double>(CellsPerFace * side * side, FewestCells, MostCells));
    this->findCells(judge.editor(), t);
    CavityLimits limits;
    limits.swallowed = judge.switches().removeNodes ? judge.wide() : 0;
    limits.detour = this->mostCells_;
    limits.cells = std::min<int>(
      limits.detour, std::max<int>(FewestCells, CellsPerNode * limits.swallowed));
    limits.hopeless = Hopeless * judge.mesh().quality(t);
    std::size_t from = 0;
    for (std::size_t to : BestCells)
    {
      this->findSeeds(judge.mesh(), from, to);
      if (!this->seeds_.empty() && this->insertion_.improve(judge, t, this->seeds_, limits))
      {
        return true;
      }
      if (!judge.isWidePatient())
      {
        break;
      }
      from = to;
    }
    return false;
  }

private:
  /// The most cells of a cavity: CellsPerFace times the number of those on a face of a cube, if the
  /// mesh were one, between FewestCells and MostCells. Flat cells can lie in tens of layers, and be
  /// as long as the mesh is wide.
  static constexpr double CellsPerFace = 1.15, FewestCells = 400, MostCells = 10000;
  /// Nor more than this for each node that may vanish. Of the cavities that gain, hardly any has
  /// more; and most of the time goes to others that grow up to a limit. With 5, the worst cells of
  /// some slabs of random points end at a third.
  static constexpr int CellsPerNode = 8;
  /// Cells that give seeds: the best of the first FirstCells around, and of each next group, which
  /// has twice as many cells as all before it and FirstCells more. At first the first of BestCells
  /// of each; most seeds are in vain, so for the worst cell of the mesh more are tried if that does
  /// not help, up to the next numbers.
  static constexpr std::size_t BestCells[] = { 2, 8, 32 }, FirstCells = 8;
  /// Where the seeds of a cell lie on the way to it from the bad one. The nearer ones need smaller
  /// cavities, in which fewer nodes vanish.
  static constexpr double Parts[] = { 1.0, 0.5, 0.25 };
  /// A seed is given up where what is kept holds it under this part of the cell's quality: such
  /// seeds hardly ever gain when the node moves.
  static constexpr double Hopeless = 0.3;

  /// The cells around cell t, the nearest first, as far as the chunk reaches.
  void findCells(MeshEditor<D>& editor, Index t)
  {
    const SimplexMesh<D>& mesh = editor.mesh();
    const std::uint32_t mark = editor.newMark();
    editor.setMark(t, mark);
    this->cells_ = { t };
    const auto most = static_cast<std::size_t>(this->mostCells_);
    for (std::size_t k = 0; k < this->cells_.size() && this->cells_.size() < most; ++k)
    {
      for (int i = 0; i <= D; ++i)
      {
        const Index h = mesh.adjacent(this->cells_[k], i);
        const Index c = h == None || mesh.isKept(this->cells_[k], i) ? None : mesh.cellOf(h);
        if (c != None && editor.owns(c) && !editor.isMarked(c, mark))
        {
          editor.setMark(c, mark);
          this->cells_.push_back(c);
        }
      }
    }
  }

  /// Seeds of the best cells of each group, but for `from` of them, up to `to`.
  void findSeeds(const SimplexMesh<D>& mesh, std::size_t from, std::size_t to)
  {
    this->seeds_.clear();
    const Vec<D> start = barycentre(mesh, this->cells_[0]);
    for (std::size_t begin = 1, end = 0; begin < this->cells_.size(); begin = end)
    {
      end = std::min(this->cells_.size(), 2 * begin + FirstCells);
      const auto first = this->cells_.begin() + begin;
      const auto last = first + std::min(to, end - begin);
      std::partial_sort(first, last, this->cells_.begin() + end,
        [&](Index a, Index b)
        { return std::pair(-mesh.quality(a), a) < std::pair(-mesh.quality(b), b); });
      for (auto c = first + std::min<std::ptrdiff_t>(from, last - first); c != last; ++c)
      {
        const Vec<D> x = barycentre(mesh, *c);
        for (double part : Parts)
        {
          this->seeds_.push_back({ start + part * (x - start), {}, {} });
        }
      }
    }
  }

  static Vec<D> barycentre(const SimplexMesh<D>& mesh, Index c)
  {
    Vec<D> sum = Vec<D>::Zero();
    for (const Vec<D>& x : mesh.corners(c))
    {
      sum += x;
    }
    return sum / (D + 1);
  }

  int mostCells_ = 0;
  NodeInsertion<D, Shape> insertion_;
  std::vector<Index> cells_;
  std::vector<typename NodeInsertion<D, Shape>::Seed> seeds_;
};
}

#endif
