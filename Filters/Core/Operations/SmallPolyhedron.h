// SPDX-License-Identifier: BSD-3-Clause
/// @file SmallPolyhedron.h
/// Small polyhedron reconnection: a few cells around a bad one are removed together, and the
/// polyhedron they leave is filled in the best possible way. The last resort where no single
/// operation helps, as in meshes with nearly all nodes on the kept surface.
///
/// Reference: see PolyhedronSearch.h. Two things are not from there:
///  - The polyhedron grows from the bad cell, guided by what the search lacks. While a facet of its
///    boundary has no good tetrahedron, the cell behind that facet is taken in. If the facet is
///    kept, it is the neighbour that offers the best apex instead. Cells all of whose nodes are
///    there already come along.
///  - If a facet has no good tetrahedron, places for new nodes can be offered: between its
///    barycentre and the apex that would be best for it. The search uses those that it needs.
#ifndef meshopt_Operations_SmallPolyhedron_h
#define meshopt_Operations_SmallPolyhedron_h

#include "Bound/ApexBound.h"
#include "Edit/QualityModel.h"
#include "Mesh/KeptEdges.h"
#include "Mesh/LocalNumbers.h"
#include "Mesh/MeshEditor.h"
#include "Operations/PolyhedronSearch.h"

#include <algorithm>

namespace meshopt
{
/// How far a SmallPolyhedron may grow, and how long its fillings are looked for.
struct PolyhedronLimits
{
  int points = 20;   ///< most nodes of the polyhedron, in [5, 32]
  int cells = 60;    ///< most cells removed
  int newPoints = 0; ///< most places offered for new nodes; 0 in a varying metric
  /// Where these places are: between a facet that has no good tetrahedron (0) and its best apex
  /// (1), and also half way to this height. In ]0, 1]. To try 1 as well costs more than it helps.
  double height = 0.5;
  bool mayDropPoints = true; ///< free nodes inside may vanish
  int searches = 30;         ///< most searches of one propose(); the polyhedron grows in between
  long steps = 2000;         ///< most steps of one search; typically some tens are needed
};

template <class Shape>
class SmallPolyhedron
{
public:
  /// cells() contains FirstNew - k in place of an id for newPoints()[k].
  static constexpr Index FirstNew = -2;

  /// Tries to replace cell t and some cells around it. Returns the worst quality of the best
  /// refilling if it is above `above` and above the worst of the removed cells, by more than
  /// rounding errors; else -infinity. Kept facets and edges stay, and so do cells that the editor
  /// does not own.
  ///
  /// `enough(c, i)` is a quality that is good enough on kept facet i of cell c, or -1 if there is
  /// none. A cell on such a facet, old or new, does not count among the worst if it has this
  /// quality. It is meant for facets whose own shape caps the cells on them: without it, no
  /// polyhedron at such a facet could get better. It must be at least the quality of cell c, if
  /// nothing is to get worse there.
  ///
  /// The time is proportional to the number of searches, and for each to the fourth power of the
  /// number of points. Most polyhedra that cannot be filled better are refused before the first
  /// step.
  template <class Enough>
  double propose(const MeshEditor<3>& editor, const QualityModel<3, Shape>& model, Index t,
    double above, const PolyhedronLimits& limits, Enough&& enough);
  /// The same without `enough`.
  double propose(const MeshEditor<3>& editor, const QualityModel<3, Shape>& model, Index t,
    double above, const PolyhedronLimits& limits = {});

  /// Of the last successful propose(): the removed cells, their worst quality, and the new cells.
  const std::vector<Index>& cavity() const { return this->cavity_; }
  double oldWorst() const { return this->worst_; }
  const std::vector<Simplex<3>>& cells() const { return this->cells_; }
  /// Places of the new nodes that cells() uses.
  const std::vector<Vec<3>>& newPoints() const { return this->newPoints_; }
  /// Replaces FirstNew - k by ids[k] in cells().
  void nameNewPoints(const std::vector<Index>& ids);

private:
  static constexpr double Never = -std::numeric_limits<double>::infinity();
  static constexpr int MaximumPoints = PolyhedronSearch::MaximumPoints;
  static constexpr double Rounding = 1e-12; // a smaller gain may be the same cells in another order
  static constexpr double AsGoodAsAny = 2.0; // added to a quality that is enough

  /// A facet of the boundary.
  struct Face
  {
    PolyhedronSearch::Triangle nodes;
    Index cell;
    int facet;
    Index behind;  // the cell across if it may be taken in, or None
    double enough; // see propose(); or -1
    double best;   // greatest quality with any point of the polyhedron as apex
    bool offered;  // new points were offered for it
  };

  void start(const MeshEditor<3>& editor, const QualityModel<3, Shape>& model,
    const PolyhedronLimits& limits);
  int addPoint(const Vec<3>& x, Index id, bool stay);
  int numberOf(Index p);
  double quality(const PolyhedronSearch::Tetrahedron& t) const;
  double qualityOn(const Face& f, int p) const;
  int newcomers(Index c);
  bool closesKept(Index c);
  template <class Enough>
  bool take(Index c, Enough& enough);
  template <class Enough>
  void takeAlong(Enough& enough);
  Index behind(Index c, int i) const;
  Index nextCell(int bare);
  bool offerPoints(int bare);
  int worstFace(double above) const;
  double fill(double above, int& bare);
  void noteEnough();
  double rating(const PolyhedronSearch::Candidate& t) const;
  void keepSolution();

  const MeshEditor<3>* editor_ = nullptr;
  const QualityModel<3, Shape>* model_ = nullptr;
  PolyhedronLimits limits_;
  PolyhedronSearch search_;
  int searches_ = 0; ///< of this propose()

  LocalNumbers meshPoints_, taken_;    // nodes of the mesh; cells
  std::vector<std::uint8_t> numberOf_; // by meshPoints_: number of the point
  std::vector<Vec<3>> x_;              // by number
  std::vector<Index> ids_;             // by number: node of the mesh, or FirstNew - k
  double weight_[MaximumPoints][MaximumPoints];
  std::vector<Face> faces_;
  std::vector<PolyhedronSearch::Triangle> boundary_;
  std::vector<double> enoughOfSide_; // by PolyhedronSearch::sideOf()
  bool anyEnough_ = false;

  double worst_ = 0.0;
  std::vector<Index> cavity_;
  std::vector<Simplex<3>> cells_;
  std::vector<Vec<3>> newPoints_, offers_;
};
}

#include "Operations/SmallPolyhedron.hxx"

#endif
