// SPDX-License-Identifier: BSD-3-Clause
/// @file Tangle.h
/// Whether cells of the mesh may overlap: every change then needs expensive checks.
#ifndef meshopt_WorstFirst_Tangle_h
#define meshopt_WorstFirst_Tangle_h

#include "Mesh/PinchedPoints.h"
#include "Run/Summary.h"
#include "Surface/SurfaceFaults.h"
#include "WorstFirst/Constants.h"

#include <optional>

namespace meshopt
{
namespace worstfirst
{
template <int D>
class Tangle
{
public:
  /// Looks at the mesh, which must outlive this object. Qualities must be up to date.
  /// `hadInverted`: the mesh had inverted cells at some time before.
  Tangle(const SimplexMesh<D>& mesh, bool hadInverted)
    : mesh_(mesh)
    , mayOverlap_(hadInverted || mesh.numberOfFoldedFacets() > 0 || hasLostSigns(mesh))
  {
    if (this->mayOverlap_ || (D == 2 && mesh.countCells() < CellsPerChunk)) // elsewhere too slow
    {
      this->pinched_ = pinchedPoints<D>(mesh);
      this->mayOverlap_ = this->mayOverlap_ || !this->pinched_.empty();
    }
    long inverted = 0;
    if (this->mayOverlap_)
    {
      constexpr double anyTarget = 0.0; // only inverted cells are counted
      summarize(mesh, anyTarget, &inverted);
    }
    this->setInverted(inverted);
  }

  bool mayOverlap() const { return this->mayOverlap_; }
  bool hasInverted() const { return this->hasInverted_; }
  const std::vector<std::uint8_t>& pinched() const { return this->pinched_; }

  /// Sets the number of inverted cells. Cells may overlap even if none is inverted: this is checked
  /// once, when no cell is inverted any more.
  void setInverted(long cells)
  {
    this->hasInverted_ = cells > 0;
    if (this->mayOverlap_ && !this->hasInverted_)
    {
      if (!this->found_)
      {
        this->found_ = this->mesh_.numberOfFoldedFacets() > 0 ||
          meshopt::mayOverlap<D>(this->mesh_, this->pinched_);
      }
      this->mayOverlap_ = *this->found_;
    }
  }

private:
  const SimplexMesh<D>& mesh_;
  bool mayOverlap_;
  bool hasInverted_ = true;
  std::vector<std::uint8_t> pinched_; ///< see PinchedPoints.h
  std::optional<bool> found_; ///< by the check, once no cell is inverted: may cells overlap?
};
}
}

#endif
