// SPDX-License-Identifier: BSD-3-Clause
/// @file FaceRemoval.h
/// Replaces the face between two tetrahedra by the edge between their apexes: the 2-3 flip.
#ifndef meshopt_Operations_FaceRemoval_h
#define meshopt_Operations_FaceRemoval_h

#include "Edit/QualityModel.h"
#include "Mesh/MeshEditor.h"

#include <algorithm>

namespace meshopt
{
template <class Shape>
class FaceRemoval
{
public:
  /// Tries facet i of cell t. Returns the worst quality of the three new cells if it is above
  /// `above` and above both old ones, else -infinity.
  double propose(
    const MeshEditor<3>& editor, const QualityModel<3, Shape>& model, Index t, int i, double above)
  {
    const SimplexMesh<3>& mesh = editor.mesh();
    const Index h = mesh.adjacent(t, i);
    if (h == None || mesh.isKept(t, i) || !editor.owns(mesh.cellOf(h)))
    {
      return Never;
    }
    const Index o = mesh.cellOf(h);
    this->cavity_ = { t, o };
    this->worst_ = std::min(mesh.quality(t), mesh.quality(o));
    const Facet<3> f = mesh.facet(t, i);
    const Index a = mesh.nodes(t)[i], b = mesh.nodes(o)[mesh.facetOf(h)];
    this->cells_ = { Simplex<3>{ f[0], f[1], b, a }, Simplex<3>{ f[1], f[2], b, a },
      Simplex<3>{ f[2], f[0], b, a } };
    double worst = std::numeric_limits<double>::infinity();
    const double beat = std::max(above, this->worst_);
    for (const Simplex<3>& cell : this->cells_)
    {
      worst = std::min(worst, model(cell));
      if (!(worst > beat))
      {
        return Never;
      }
    }
    return worst;
  }

  /// The worse quality of the two cells of the last propose().
  double oldWorst() const { return this->worst_; }
  const std::vector<Index>& cavity() const { return this->cavity_; }
  const std::vector<Simplex<3>>& cells() const { return this->cells_; }

private:
  static constexpr double Never = -std::numeric_limits<double>::infinity();

  std::vector<Index> cavity_;
  std::vector<Simplex<3>> cells_;
  double worst_ = 0.0;
};
}

#endif
