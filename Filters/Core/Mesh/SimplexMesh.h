// SPDX-License-Identifier: BSD-3-Clause
/// @file SimplexMesh.h
/// The mesh that is optimized: points, cells, adjacency, and what must be kept.
///
/// Adjacency over facets is found once, by a linear bucket sort, when the mesh is built. From then
/// on MeshEditor updates it. There is no table of edges: rings and stars are found by walking over
/// facets.
#ifndef meshopt_Mesh_SimplexMesh_h
#define meshopt_Mesh_SimplexMesh_h

#include "Mesh/Place.h"
#include "Mesh/Types.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace meshopt
{
/// The input of a mesh. Points that no cell uses are legal and stay as they are.
template <int D>
struct MeshInput
{
  std::vector<Vec<D>> points;
  std::vector<Simplex<D>> cells;
  /// Region of each cell, or empty (all one region). Facets between regions are kept.
  std::vector<Index> regions;
  /// Nonzero: the point neither moves nor vanishes. One per point, or empty.
  std::vector<std::uint8_t> fixedPoints;
  /// For a part of a mesh. Nonzero: cells of other parts use the point, too, and it will be free in
  /// a run of its own. The best effort then leaves the cells around it as they are once they are at
  /// the target, and does not count them. One per point, or empty. Holds no point by itself.
  std::vector<std::uint8_t> borderPoints;
  /// Facets that must be kept although both sides have one region (any order of the points).
  std::vector<Facet<D>> keptFacets;
  /// Edges that must be kept (any order of the points). For D = 2 use keptFacets.
  std::vector<std::array<Index, 2>> keptEdges;
  /// True: the numbering of every cell is correct, and no cell is renumbered. For a part of a mesh
  /// whose orientation is known: the volume of the part alone may mislead.
  bool isOriented = false;
};

/// Why a mesh could not be built: a sentence for the user that says what is wrong and where.
struct MeshError
{
  std::string message;
  Index cell = None;  ///< first offending cell of the input, or None
  Index point = None; ///< first offending point of the input, or None
};

/// A conforming mesh of simplices. Cells and points live in slots. A slot may be dead after an edit
/// and be used again. Slots of input points are never used for another point, so that point p <
/// numberOfInputPoints() is always point p of the input.
template <int D>
class SimplexMesh
{
public:
  enum CellFlag : std::uint16_t
  {
    /// Bits 0..3: facet i is kept (surface, interface between regions, or by the caller's wish).
    FacetBits = 0x000f,
    /// Bits 4..9: edge i is kept by the caller's wish. Edges of kept facets are not marked.
    FirstEdgeBit = 4,
    EdgeBits = 0x03f0,
    CellAlive = 0x8000
  };

  enum PointFlag : std::uint8_t
  {
    PointHeld = 1,     ///< not free: on a kept facet or edge, or fixed by the caller
    PointBoundary = 2, ///< lies on a kept facet
    PointAlive = 8,    ///< is used by a cell
    PointFixedByUser = 16,
    PointAtBorder = 32 ///< see MeshInput::borderPoints
  };

  /// Topology of a cell. adjacent[i] is the handle of the facet across facet i; None at the
  /// surface. handle = 4 * cell + facet.
  struct Cell
  {
    Simplex<D> nodes;
    std::array<Index, D + 1> adjacent;
  };

  /// Other data of a cell.
  struct CellData
  {
    double quality = 0.0;           ///< updated by whoever edits; see MeshEditor
    Index region = 0;               ///< region of the input
    Index parent = None;            ///< input cell whose data this cell takes
    std::uint32_t stamp = 0;        ///< for algorithms: last failed try
    mutable std::uint32_t mark = 0; ///< scratch of the MeshEditor that owns the cell
    std::uint16_t flags = 0;
    std::uint8_t level = 0; ///< for algorithms: effort of the last failed try
  };

  struct Point
  {
    Vec<D> x;
    Index cell = None;              ///< a cell that uses the point
    std::uint32_t stamp = 0;        ///< last change in the star of the point
    std::uint32_t moveFailed = 0;   ///< for algorithms: last failed try to move it
    std::uint32_t removeFailed = 0; ///< for algorithms: last failed try to remove it
    Index owner = 0;                ///< chunk that may edit around the point (parallel passes)
    std::uint8_t flags = 0;

    /// Copies all of `old` except the owner, which threads of other chunks may be reading. They may
    /// also read coordinates next to their chunk: these have not changed, and are not written.
    void restore(const Point& old)
    {
      if (std::memcmp(this->x.data(), old.x.data(), sizeof(old.x)) != 0)
      {
        this->x = old.x;
      }
      this->cell = old.cell;
      this->stamp = old.stamp;
      this->moveFailed = old.moveFailed;
      this->removeFailed = old.removeFailed;
      this->flags = old.flags;
    }
  };

  /// Builds the mesh; linear in the size of the input. A malformed input is an error and leaves
  /// `mesh` empty: a point id out of range, a point twice in a cell, coordinates that are not
  /// finite, a facet with more than two cells, a cell given twice, or arrays of a wrong length.
  /// Inverted and flat cells are legal.
  /// Cells numbered against their neighbours are renumbered (the last two nodes are swapped),
  /// unless input.isOriented: each connected component is then consistently oriented, with positive
  /// total volume. numberOfReorientedCells() counts these cells. A component without a cell of
  /// negative volume is not renumbered: neighbours that are not numbered alike overlap there.
  /// numberOfFoldedFacets() counts the facets between them.
  static std::optional<MeshError> build(const MeshInput<D>& input, SimplexMesh& mesh);

  // --- sizes
  Index numberOfCellSlots() const { return static_cast<Index>(this->cells_.size()); }
  Index numberOfPointSlots() const { return static_cast<Index>(this->points_.size()); }
  Index numberOfInputPoints() const { return this->inputPoints_; }
  Index numberOfInputCells() const { return this->inputCells_; }
  Index numberOfReorientedCells() const { return this->reoriented_; }
  /// Number of input facets that have both their cells on the same side.
  Index numberOfFoldedFacets() const { return this->foldedFacets_; }
  /// The nodes of one such facet, if there is one.
  const Facet<D>& firstFoldedFacet() const { return this->firstFoldedFacet_; }
  Index countCells() const;  ///< live cells; linear
  Index countPoints() const; ///< points used by a cell; linear
  bool hasKeptEdges() const { return this->hasKeptEdges_; }

  // --- cells
  bool isAlive(Index c) const { return (this->cellData_[c].flags & CellAlive) != 0; }
  const Simplex<D>& nodes(Index c) const { return this->cells_[c].nodes; }
  /// Handle of the facet on the other side of facet i of cell c, or None.
  Index adjacent(Index c, int i) const { return this->cells_[c].adjacent[i]; }
  static Index cellOf(Index handle) { return handle >> 2; }
  static int facetOf(Index handle) { return handle & 3; }
  static Index handle(Index c, int i) { return 4 * c + i; }
  /// True if facet i must be kept. Surface facets are always kept.
  bool isKept(Index c, int i) const { return (this->cellData_[c].flags >> i) & 1; }
  /// True if edge e, numbered as in Local<D>::edges, is marked as kept: by the caller's wish, or as
  /// part of a curve of the surface. Edges of kept facets need no mark. Never in 2D.
  bool isEdgeKeptByItself(Index c, int e) const
  {
    return (this->cellData_[c].flags >> (FirstEdgeBit + e)) & 1;
  }
  /// The same for edge e numbered as in Local<D>::edgeFirst; in 2D, where an edge is a facet,
  /// whether this facet is kept.
  bool isEdgeKept(Index c, int e) const
  {
    return D == 2 ? this->isKept(c, e) : this->isEdgeKeptByItself(c, e);
  }
  /// Number of the patch of the surface that kept facet i belongs to; None if there are no patches.
  Index patch(Index c, int i) const { return this->patches_.empty() ? None : this->patches_[c][i]; }
  double quality(Index c) const { return this->cellData_[c].quality; }
  /// The least of the stored qualities; infinity if there are no cells.
  double worstQuality(const std::vector<Index>& cells) const
  {
    double worst = std::numeric_limits<double>::infinity();
    for (Index c : cells)
    {
      worst = std::min(worst, this->cellData_[c].quality);
    }
    return worst;
  }
  Index region(Index c) const { return this->cellData_[c].region; }
  Index parent(Index c) const { return this->cellData_[c].parent; }
  const CellData& cellData(Index c) const { return this->cellData_[c]; }
  Corners<D> corners(Index c) const
  {
    Corners<D> x;
    for (int i = 0; i <= D; ++i)
    {
      x[i] = this->points_[this->cells_[c].nodes[i]].x;
    }
    return x;
  }
  /// Nodes of facet i, ordered as in Local<D>::facets.
  Facet<D> facet(Index c, int i) const
  {
    Facet<D> f;
    for (int k = 0; k < D; ++k)
    {
      f[k] = this->cells_[c].nodes[Local<D>::facets[i][k]];
    }
    return f;
  }
  /// Local number of point p in cell c, or -1.
  int localIndex(Index c, Index p) const
  {
    for (int i = 0; i <= D; ++i)
    {
      if (this->cells_[c].nodes[i] == p)
      {
        return i;
      }
    }
    return -1;
  }
  /// Local number of the edge (a, b) of cell c as in Local<D>::edgeFirst, or -1.
  int localEdge(Index c, Index a, Index b) const
  {
    const Simplex<D>& t = this->cells_[c].nodes;
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      const Index p = t[Local<D>::edgeFirst[e][0]], q = t[Local<D>::edgeFirst[e][1]];
      if ((p == a && q == b) || (p == b && q == a))
      {
        return e;
      }
    }
    return -1;
  }
  /// The facet at the edge (a, b) of cell c that is not facet i; the first one if i is -1. For
  /// walks around an edge; D = 3 only.
  int otherFacet(Index c, int i, Index a, Index b) const
  {
    const Simplex<D>& t = this->cells_[c].nodes;
    int other = 0;
    while (other == i || t[other] == a || t[other] == b)
    {
      ++other;
    }
    return other;
  }

  // --- points
  const Vec<D>& point(Index p) const { return this->points_[p].x; }
  const Point& pointData(Index p) const { return this->points_[p]; }
  /// True if the point is on nothing that is kept: it may move anywhere, or vanish.
  bool isFree(Index p) const { return (this->points_[p].flags & PointHeld) == 0; }
  Freedom freedom(Index p) const
  {
    return this->isFree(p) ? Freedom::Free : this->place(p).freedom;
  }
  /// The place of the point on the surface, if it slides.
  Place place(Index p) const { return this->places_.empty() ? Place() : this->places_[p]; }
  bool isBoundary(Index p) const { return (this->points_[p].flags & PointBoundary) != 0; }
  bool isAtBorder(Index p) const { return (this->points_[p].flags & PointAtBorder) != 0; }
  bool hasBorder() const { return this->hasBorder_; } ///< whether any point is at one
  bool isPointAlive(Index p) const { return (this->points_[p].flags & PointAlive) != 0; }
  Index cellOfPoint(Index p) const { return this->points_[p].cell; }

  /// Cells that share point p, found over facets from one of them; kept facets are crossed, and
  /// surface points are allowed. Overwrites `star`. Allocates no memory once `star` is large
  /// enough.
  void star(Index p, std::vector<Index>& star) const;

  /// Cells around the edge (a, b) of cell c, in ring order; D = 3 only. Returns true if the ring is
  /// closed and crosses no kept facet; it then starts with c. Otherwise the list still contains,
  /// from end to end, all cells that can be reached without crossing a kept facet (acrossKept
  /// false) or the surface (acrossKept true).
  bool ring(Index c, Index a, Index b, bool acrossKept, std::vector<Index>& ring) const;

  /// Checks all invariants, for tests and debugging. Returns a sentence for each broken one; empty
  /// if there is none. Checked are: symmetric adjacency, facets with at most two cells, kept facets
  /// marked on both sides, cells of points, flags of points, no live cell with a dead point, and
  /// positive orientation if `requirePositive`.
  std::vector<std::string> audit(bool requirePositive) const;

  /// Sum of signed volumes (areas) of the live cells.
  double volume() const;

private:
  template <int>
  friend class MeshEditor;
  template <int>
  friend struct MeshBuilder;
  friend struct MeshTestAccess;

  std::vector<Cell> cells_;
  std::vector<CellData> cellData_;
  std::vector<Point> points_;
  std::vector<Place> places_;                     // one per point slot, or none: nothing slides
  std::vector<std::array<Index, D + 1>> patches_; // of the facets of each cell slot, or none
  Index inputPoints_ = 0;
  Index inputCells_ = 0;
  Index reoriented_ = 0;
  Index foldedFacets_ = 0;
  Facet<D> firstFoldedFacet_{};
  bool hasKeptEdges_ = false;
  bool hasBorder_ = false;
};

extern template class SimplexMesh<2>;
extern template class SimplexMesh<3>;
}

#endif
