// SPDX-License-Identifier: BSD-3-Clause
/// @file Weights.h
/// Cells on facets with tiny caps, judged by what they could have (Caps::weight()).
#ifndef meshopt_WorstFirst_Weights_h
#define meshopt_WorstFirst_Weights_h

#include "Bound/Caps.h"
#include "Edit/QualityModel.h"
#include "Mesh/MeshEditor.h"

#include <algorithm>

namespace meshopt
{
/// Switches between qualities as they are and weighed ones, which the mesh then holds. Linear each
/// time where facets have tiny caps; nothing at all where none has.
template <int D, class Shape>
class Weights
{
public:
  Weights(MeshEditor<D>& editor, QualityModel<D, Shape>& model, Caps<D>& caps)
    : editor_(editor)
    , model_(model)
    , caps_(caps)
  {
  }

  bool areOn() const { return this->model_.weights != nullptr; }

  /// From now on qualities are weighed, but never such that one gets worse than the worst is now: that
  /// is the floor. Called again, it raises the floor to what is the worst by then.
  void switchOn()
  {
    if (this->caps_.hasTiny())
    {
      this->model_.floor = std::max(0.0, this->update(nullptr));
      this->update(&this->caps_);
      this->caps_.setWeighed(true);
    }
  }
  void switchOff()
  {
    if (this->areOn())
    {
      this->model_.floor = std::max(0.0, this->update(nullptr));
      this->caps_.setWeighed(false);
    }
  }

private:
  /// Computes the qualities of cells with a weight anew; returns the worst of all.
  double update(const Caps<D>* weights)
  {
    const SimplexMesh<D>& mesh = this->editor_.mesh();
    this->model_.weights = weights;
    double worst = 1.0;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      if (mesh.isAlive(c))
      {
        const Simplex<D>& nodes = mesh.nodes(c);
        if (this->caps_.weight(mesh, nodes) > 1.0)
        {
          this->editor_.setQuality(c, this->model_(nodes));
        }
        worst = std::min(worst, mesh.quality(c));
      }
    }
    return worst;
  }

  MeshEditor<D>& editor_;
  QualityModel<D, Shape>& model_;
  Caps<D>& caps_;
};
}

#endif
