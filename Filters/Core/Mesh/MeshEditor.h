// SPDX-License-Identifier: BSD-3-Clause
/// @file MeshEditor.h
/// The only way to change a SimplexMesh: replace a cavity, move a point; all of it can be undone.
#ifndef meshopt_Mesh_MeshEditor_h
#define meshopt_Mesh_MeshEditor_h

#include "Mesh/PointAttachment.h"
#include "Mesh/SimplexMesh.h"

#include <memory>

namespace meshopt
{
/// How a replacement changes what is kept, where the surface itself is remeshed.
template <int D>
struct KeptChange
{
  using Edge = std::array<Index, 2>;

  std::vector<Facet<D>> gone; ///< kept facets of the cavity, at its boundary or inside, that vanish
  std::vector<Facet<D>> come; ///< facets of the new cells that are kept from now on
  std::vector<Index> patches; ///< SimplexMesh::patch() of each that comes; empty: None for all
  std::vector<Edge> goneEdges, comeEdges; ///< the same for kept edges (D = 3)
  std::vector<Index> regions;             ///< of each new cell

  void clear()
  {
    this->gone.clear();
    this->come.clear();
    this->patches.clear();
    this->goneEdges.clear();
    this->comeEdges.clear();
    this->regions.clear();
  }
};

/// Edits a mesh through two operations, both journalled while a transaction is open:
///  - replace(): exchange a cavity (cells) for other cells that fill the same boundary;
///  - movePoint().
/// The journal carries cells, adjacency, kept facets and edges, regions, parents, points and their
/// stamps, places on the surface, and the attachments (values at points that are kept elsewhere, such
/// as the metric): rollback() brings all of it back, bit for bit. Qualities are given by the caller,
/// who has just computed them to decide.
///
/// Geometry is not looked at: whether the new cells are positively oriented, or better, is the
/// caller's business; that they fill the cavity's boundary exactly is asserted in debug builds.
///
/// Several editors may work on one mesh at the same time if each touches only cells all of whose
/// points it owns (Point::owner); see setOwner(). Then it takes slots from its own pool only.
template <int D>
class MeshEditor
{
public:
  using Mesh = SimplexMesh<D>;

  /// Scans the mesh for the latest mark and stamp; linear.
  explicit MeshEditor(Mesh& mesh);
  /// One more editor of the same mesh, with the same attachments, clock and marks; O(1).
  static MeshEditor beside(const MeshEditor& other);

  Mesh& mesh() { return *this->mesh_; }
  const Mesh& mesh() const { return *this->mesh_; }

  /// From now on the values of `attachment` follow the points, and the journal carries them. It must
  /// live as long as the editor. Not within a transaction.
  void attach(PointAttachment<D>& attachment);
  /// Ends that. Not within a transaction.
  void detach(PointAttachment<D>& attachment);

  /// Replaces the cells `cavity` by `cells` (positively numbered point ids, points from the cavity
  /// or from addPoint), with the qualities `qualities`. New cell ids, in the order of `cells`, are
  /// in created(). Points of the cavity that no new cell uses die (they must be interior to the
  /// cavity), which has no kept facet inside. All cells of the cavity have one region; a new cell
  /// takes its parent from the cavity cell behind its facet.
  /// With `change` the boundary of the cavity may differ where it is the surface, and the cavity may
  /// have several regions and the kept facets between them inside.
  /// Returns false, with nothing changed, only if no slot is left in the editor's pool.
  bool replace(const std::vector<Index>& cavity, const std::vector<Simplex<D>>& cells,
    const std::vector<double>& qualities, const KeptChange<D>* change = nullptr);
  const std::vector<Index>& created() const { return this->created_; }

  /// A new point at x that no cell uses yet; None if no slot is left in the editor's pool.
  /// Attachments get their values for it when it is placed by movePoint().
  Index addPoint(const Vec<D>& x);

  /// Moves a point, and stamps it unless it is there already. Attachments follow. `near`: a point near x, for a new point that has
  /// no value yet; None: the point itself. Qualities of its star are the caller's to set.
  void movePoint(Index p, const Vec<D>& x, Index near = None);

  /// Says where on the surface the point lies; changes nothing else. The first call must be outside of
  /// transactions.
  void setPlace(Index p, const Place& place);

  /// Says of which patch of the surface the kept facet i of cell c is; on both of its sides. The
  /// first call must be outside of transactions.
  void setPatch(Index c, int i, Index patch);

  void setQuality(Index c, double q);
  /// Stamps all points of these cells with a new time: their stars have changed.
  void stamp(const std::vector<Index>& cells);
  /// CellData::stamp and level, the algorithms' "failed at" time and effort; not journalled.
  void setFailed(Index c, std::uint32_t stamp, int level)
  {
    this->mesh_->cellData_[c].stamp = stamp;
    this->mesh_->cellData_[c].level = static_cast<std::uint8_t>(level);
  }

  /// Point::moveFailed and removeFailed; not journalled.
  void setMoveFailed(Index p, std::uint32_t stamp) { this->mesh_->points_[p].moveFailed = stamp; }
  void setRemoveFailed(Index p, std::uint32_t stamp)
  {
    this->mesh_->points_[p].removeFailed = stamp;
  }

  /// The time of the latest edit. Points around an edit carry it as their stamp.
  std::uint32_t clock() const { return this->clock_; }
  void setClock(std::uint32_t clock) { this->clock_ = clock; }

  // --- transactions
  /// Opens a transaction (they may be nested); returns its place in the journal.
  std::size_t begin();
  /// Keeps what was done since `place`. The journal is emptied when the outermost one commits.
  void commit(std::size_t place);
  bool inTransaction() const { return this->depth_ > 0; }
  /// Undoes what was done since `place`, in reverse, bit for bit.
  void rollback(std::size_t place);

  // --- scratch marks on cells: O(1) sets of cells
  /// Starts an empty set; the one before is forgotten.
  std::uint32_t newMark() { return ++this->mark_; }
  bool isMarked(Index c, std::uint32_t m) const { return this->mesh_->cellData_[c].mark == m; }
  void setMark(Index c, std::uint32_t m) const { this->mesh_->cellData_[c].mark = m; }
  std::uint32_t lastMark() const { return this->mark_; }
  void setLastMark(std::uint32_t m) { this->mark_ = m; }

  // --- parallel rounds
  /// Restricts the editor to cells all of whose points have this owner, and to the slots of
  /// freeCells() and freePoints(). None (the default): all cells, and the mesh grows as needed.
  void setOwner(Index owner) { this->owner_ = owner; }
  bool owns(Index c) const
  {
    if (this->owner_ == None)
    {
      return true;
    }
    for (Index p : this->mesh_->cells_[c].nodes)
    {
      if (this->mesh_->points_[p].owner != this->owner_)
      {
        this->blocked_ = true;
        return false;
      }
    }
    return true;
  }
  /// True if, since the last resetBlocked(), something was refused because another editor owns it
  /// or because the pool was empty: a failure that says nothing about the mesh.
  bool blocked() const { return this->blocked_; }
  void resetBlocked() { this->blocked_ = false; }
  void setPointOwner(Index p, Index owner) { this->mesh_->points_[p].owner = owner; }
  /// Dead slots that this editor may use, taken from the back.
  std::vector<Index>& freeCells() { return this->freeCells_; }
  std::vector<Index>& freePoints() { return this->freePoints_; }
  /// Appends n dead slots to the mesh (not while another editor works) and adds them to the pool.
  void growCells(Index n);
  void growPoints(Index n);

  /// Star of p as SimplexMesh::star, by marks: faster. Returns false, with `star` incomplete, as
  /// soon as it meets a cell that the editor does not own.
  bool star(Index p, std::vector<Index>& star);

private:
  using Cell = typename Mesh::Cell;
  using CellData = typename Mesh::CellData;
  using Point = typename Mesh::Point;
  using AttachmentJournal = typename PointAttachment<D>::Journal;

  enum class Entry : std::uint8_t
  {
    CellChanged,
    LinkChanged,
    PointChanged,
    PlaceChanged,
    AttachmentsChanged, // of one point
    CellTaken,          // from the pool
    CellGrown,
    CellFreed,
    PointTaken,
    PointGrown,
    PointFreed
  };
  using Patches = std::array<Index, D + 1>;
  struct CellRecord
  {
    Index id;
    Cell cell;
    CellData data;
  };
  /// adjacent[] of one facet. A cell at the border of what the editor owns is never saved whole:
  /// its other facets may be another editor's.
  struct LinkRecord
  {
    Index handle;
    Index adjacent;
  };
  struct PointRecord
  {
    Index id;
    Point point;
  };
  struct PlaceRecord
  {
    Index id;
    Place place;
  };
  /// A facet met while a cavity is refilled: one of its boundary, or one between new cells.
  struct OpenFacet
  {
    Facet<D> key;  // sorted
    Index outside; // handle across it (boundary of the cavity, or first new cell), or None: surface
    Index parent;  // input cell of the cavity cell behind it
    Index patch;
    bool kept;
    bool closed; // both sides are known
  };

  MeshEditor() = default;

  bool reserveCells(std::size_t n);
  Index takeCell();
  void freeCell(Index c);
  Index takePoint();
  void saveCell(Index c);
  void savePoint(Index p);
  void savePlace(Index p);
  void saveAttachments(Index p);
  void growAttachments();
  void growPatches(bool isFirst = false);
  void undo(Entry entry);
  void collectOpenFacets(
    const std::vector<Index>& cavity, std::uint32_t inCavity, const KeptChange<D>* change);
  void collectKeptEdges(const std::vector<Index>& cavity, const KeptChange<D>* change);
  void killPoints(const std::vector<Index>& cavity);
  void buryPoints();
  void hashOpenFacets(std::size_t numberOfNewCells);
  void create(const Simplex<D>& nodes, double quality, Index region);
  Index linkFacet(Index c, int i);
  void keepEdges(Index c);
  void keepFacets(const KeptChange<D>& change);
  Index parentIn(Index region) const;

  Mesh* mesh_ = nullptr;
  std::vector<PointAttachment<D>*> attachments_;
  Index owner_ = None;
  mutable bool blocked_ = false;
  std::uint32_t clock_ = 0;
  std::uint32_t mark_ = 0;
  std::vector<Index> freeCells_, freePoints_;
  std::vector<Index> created_;

  int depth_ = 0;
  std::vector<Entry> journal_;
  std::vector<CellRecord> cellRecords_;
  std::vector<Patches> patchRecords_; // one per cell record, or none
  std::vector<LinkRecord> linkRecords_;
  std::vector<PointRecord> pointRecords_;
  std::vector<PlaceRecord> placeRecords_;
  std::vector<std::unique_ptr<AttachmentJournal>> attachmentJournals_; // one per attachment
  std::vector<Index> slotRecords_;

  // scratch of replace(): an open-addressing hash of facets
  std::vector<OpenFacet> facets_;
  std::vector<Index> table_;
  std::vector<std::array<Index, 2>> keptEdges_;
  std::vector<std::array<Index, 2>> parents_; // region and parent of each cell of the cavity
  std::vector<Index> cavityPoints_;
};

extern template class MeshEditor<2>;
extern template class MeshEditor<3>;
}

#endif
