// SPDX-License-Identifier: BSD-3-Clause
/// @file Caps.h
/// Finds the cells that cannot get better because the surface is kept. They must cost no time.
#ifndef meshopt_Bound_Caps_h
#define meshopt_Bound_Caps_h

#include "Bound/SurfaceBound.h"
#include "Mesh/IdFilter.h"
#include "Mesh/IdTable.h"

namespace meshopt
{
/// Look-up of caps of kept facets and edges below a given quality (see SurfaceBound).
template <int D>
class Caps
{
public:
  /// Prepares the look-up of caps below `limit`. `known` is false if none can be certified (if the
  /// metric varies): then nothing is capped, and bound() is 1.
  void build(const SimplexMesh<D>& mesh, Measure measure, double limit, bool known);

  double bound() const { return this->bound_; }

  /// The fraction of its cap at which a cell counts as capped; at first CapReached.
  void setReached(double fraction) { this->reached_ = fraction; }

  /// True if cell c has reached a cap of one of its kept facets, or that of a kept edge whose other
  /// cells are all better.
  bool isCapped(const SimplexMesh<D>& mesh, Index c) const;

  /// A facet with a cap under Tiny makes a bad cell in any case. Its best fourth node is far away
  /// and makes the neighbours bad, too. To spare these, cells there can be judged by what they
  /// could reach: with the weight full / cap, their quality at the cap becomes `full`. Caps under
  /// Rounding are mostly rounding errors and would allow gains without end, so no weight is greater
  /// than full / Rounding.
  static constexpr double Tiny = 0.2, Rounding = 1e-6;
  bool hasTiny() const { return !this->tiny_.empty(); }
  void setFull(double quality) { this->full_ = quality; }
  /// The weight of a facet (1 unless its cap is tiny), and the greatest weight of a cell's facets.
  double weight(const Facet<D>& f) const { return this->tiny_.mayHave(f) ? this->find(f) : 1.0; }
  double weight(const Simplex<D>& nodes) const
  {
    const unsigned facets = this->tiny_.mayHaveWithoutOne(nodes);
    return facets == 0 ? 1.0 : this->greatestWeight(nodes, facets);
  }
  /// Says whether the qualities stored in the mesh are weighted.
  void setWeighed(bool on) { this->weighed_ = on; }

  /// The quality at which a cell on kept facet i of cell c counts as capped; at least that of c. -1
  /// if no cap is known there.
  double enough(const SimplexMesh<D>& mesh, Index c, int i) const;

private:
  double find(const Facet<D>& f) const;
  double greatestWeight(const Simplex<D>& nodes, unsigned facets) const;
  bool isCappedByEdge(const SimplexMesh<D>& mesh, Index c) const;

  double reached_ = CapReached;
  double bound_ = 1.0;
  double largest_ = -1.0; // of all caps
  double full_ = 1.0;     // see setFull()
  bool weighed_ = false;
  IdTable<D> facets_;
  IdTable<2> edges_;
  // Hardly any facet or edge needs a look into the tables.
  IdFilter tiny_; ///< facets with a tiny cap
  IdFilter edgesWithCap_;
};

extern template class Caps<2>;
extern template class Caps<3>;
}

#endif
