// SPDX-License-Identifier: BSD-3-Clause
/// @file Weights.h
/// Weighted qualities: cells on facets with tiny caps are judged by what they could reach
/// (Caps::weight()).
#ifndef meshopt_WorstFirst_Weights_h
#define meshopt_WorstFirst_Weights_h

#include "Bound/Caps.h"
#include "Edit/QualityModel.h"
#include "Mesh/MeshEditor.h"

#include <algorithm>

namespace meshopt
{
/// Switches the qualities stored in the mesh between true and weighted ones. Each switch is linear
/// in the size of the mesh, but costs nothing if no facet has a tiny cap.
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

  /// From now on qualities are weighted, except for cells whose true quality is under the floor:
  /// the worst quality at this moment. No cell can therefore become worse than the floor and still
  /// look good. A further call raises the floor to the worst quality by then.
  void switchOn()
  {
    if (this->caps_.hasTiny())
    {
      this->switchOff();
      this->model_.floor = std::max(0.0, this->worst());
      this->model_.weights = &this->caps_;
      this->update(
        [this](Index c, double weight)
        {
          const double q = this->editor_.mesh().quality(c);
          return q < this->model_.floor ? q : q * weight;
        });
      this->caps_.setWeighed(true);
    }
  }
  void switchOff()
  {
    if (this->areOn())
    {
      this->model_.weights = nullptr;
      this->update([this](Index c, double) { return this->model_(this->editor_.mesh().nodes(c)); });
      this->caps_.setWeighed(false);
    }
  }

private:
  /// Replaces the quality of all cells that have a weight.
  template <class Quality>
  void update(Quality&& quality)
  {
    const SimplexMesh<D>& mesh = this->editor_.mesh();
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      const double weight = mesh.isAlive(c) ? this->caps_.weight(mesh.nodes(c)) : 1.0;
      if (weight > 1.0)
      {
        this->editor_.setQuality(c, quality(c, weight));
      }
    }
  }
  double worst() const
  {
    const SimplexMesh<D>& mesh = this->editor_.mesh();
    double worst = 1.0;
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      worst = mesh.isAlive(c) ? std::min(worst, mesh.quality(c)) : worst;
    }
    return worst;
  }

  MeshEditor<D>& editor_;
  QualityModel<D, Shape>& model_;
  Caps<D>& caps_;
};
}

#endif
