// SPDX-License-Identifier: BSD-3-Clause
/// @file Chunks.h
/// Splits the points of a mesh into chunks of neighbours for the parallel passes.
#ifndef meshopt_Run_Chunks_h
#define meshopt_Run_Chunks_h

#include "Mesh/MeshEditor.h"

#include <algorithm>

namespace meshopt
{
/// Sets Point::owner of all live points to 0 ... n - 1, by recursive bisection of the point set at
/// the median along its longest extent (ties by id). `shift`, in ]-1/2, 1/2[, moves all borders by
/// that part of a chunk; a pass with the same borders would hold up the same cells again. O(points
/// log n).
template <int D>
class Chunks
{
public:
  void assign(MeshEditor<D>& editor, int n, double shift)
  {
    this->shift_ = shift;
    const SimplexMesh<D>& mesh = editor.mesh();
    this->ids_.clear();
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      if (mesh.isPointAlive(p))
      {
        this->ids_.push_back(p);
      }
    }
    this->split(editor, 0, static_cast<Index>(this->ids_.size()), 0, n);
  }

private:
  void split(MeshEditor<D>& editor, Index begin, Index end, int first, int n)
  {
    const SimplexMesh<D>& mesh = editor.mesh();
    if (n == 1)
    {
      for (Index k = begin; k < end; ++k)
      {
        editor.setPointOwner(this->ids_[k], first);
      }
      return;
    }
    Vec<D> low = Vec<D>::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (Index k = begin; k < end; ++k)
    {
      low = low.cwiseMin(mesh.point(this->ids_[k]));
      high = high.cwiseMax(mesh.point(this->ids_[k]));
    }
    int axis = 0;
    for (int i = 1; i < D; ++i)
    {
      axis = high[i] - low[i] > high[axis] - low[axis] ? i : axis;
    }
    // An odd n is split in proportion: the left part gets n / 2 of the n chunks.
    const int left = n / 2;
    const Index middle = begin +
      static_cast<Index>(static_cast<double>(end - begin) * (left + this->shift_) / n);
    std::nth_element(this->ids_.begin() + begin, this->ids_.begin() + middle,
      this->ids_.begin() + end,
      [&](Index a, Index b)
      {
        // Ties by id: nth_element then has one answer, and so the chunks are the same on every
        // platform.
        const double xa = mesh.point(a)[axis], xb = mesh.point(b)[axis];
        return xa != xb ? xa < xb : a < b;
      });
    this->split(editor, begin, middle, first, left);
    this->split(editor, middle, end, first + left, n - left);
  }

  std::vector<Index> ids_;
  double shift_ = 0.0;
};
}

#endif
