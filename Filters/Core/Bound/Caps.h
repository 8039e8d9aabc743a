// SPDX-License-Identifier: BSD-3-Clause
/// @file Caps.h
/// Which cells cannot get better because the surface is kept: they must cost nothing.
#ifndef meshopt_Bound_Caps_h
#define meshopt_Bound_Caps_h

#include "Bound/SurfaceBound.h"
#include "Mesh/Ids.h"

#include <unordered_map>

namespace meshopt
{
/// Caps of kept facets and edges under a given quality (see SurfaceBound), for look-up.
template <int D>
class Caps
{
public:
  /// Prepares the look-up of caps below `limit`; `known` is false where none can be certified (a
  /// metric that varies): then nothing is capped and bound() is 1.
  void build(const SimplexMesh<D>& mesh, Measure measure, double limit, bool known);

  double bound() const { return this->bound_; }

  /// The fraction of its cap with which a cell counts as capped.
  void setReached(double fraction) { this->reached_ = fraction; }

  /// True if cell c has reached a cap of one of its kept facets; or that of a kept edge whose other
  /// cells are all better.
  bool isCapped(const SimplexMesh<D>& mesh, Index c) const;

  /// A facet with a cap under Tiny makes a bad cell whatever is done, and its best fourth node, far
  /// away, makes the neighbours bad, too. To spare these, cells there can be judged by what they
  /// could have: weighed with 1 / cap, such that `full` is at the cap. But not with more than
  /// 1 / Rounding: what is less is mostly rounding, and would make gains without end.
  static constexpr double Tiny = 0.2, Rounding = 1e-6;
  bool hasTiny() const { return this->hasTiny_; }
  void setFull(double quality) { this->full_ = quality; }
  /// The weight of a facet, 1 unless its cap is tiny; the greatest one of a cell's facets.
  double weight(const SimplexMesh<D>& mesh, Facet<D> f) const;
  double weight(const SimplexMesh<D>& mesh, const Simplex<D>& nodes) const;
  /// Says if the qualities that the mesh holds are weighed.
  void setWeighed(bool on) { this->weighed_ = on; }

  /// What a cell on kept facet i of cell c must have to count as capped; not less than c has. -1 if
  /// no cap is known there.
  double enough(const SimplexMesh<D>& mesh, Index c, int i) const;

private:
  struct Hash
  {
    template <std::size_t N>
    std::size_t operator()(const std::array<Index, N>& ids) const
    {
      return hashIds(ids);
    }
  };

  bool isCappedByEdge(const SimplexMesh<D>& mesh, Index c) const;

  double reached_ = 0.998;
  double bound_ = 1.0;
  double largest_ = -1.0; // of all caps
  double full_ = 1.0;     // see setFull()
  bool hasTiny_ = false, weighed_ = false;
  std::unordered_map<Facet<D>, double, Hash> facets_;
  std::unordered_map<std::array<Index, 2>, double, Hash> edges_;
};

extern template class Caps<2>;
extern template class Caps<3>;
}

#endif
