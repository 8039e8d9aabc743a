// SPDX-License-Identifier: BSD-3-Clause
/// @file MeshEditor.h
/// The only way to change a SimplexMesh: replace a cavity, or move a point. Both can be undone.
#ifndef meshopt_Mesh_MeshEditor_h
#define meshopt_Mesh_MeshEditor_h

#include "Mesh/PointAttachment.h"
#include "Mesh/SimplexMesh.h"

#include <memory>

namespace meshopt
{
/// The kept facets and edges that a replacement changes, where the surface itself is remeshed.
template <int D>
struct KeptChange
{
  using Edge = std::array<Index, 2>;

  std::vector<Facet<D>> gone; ///< kept facets that vanish: of the cavity's boundary or inside
  std::vector<Facet<D>> come; ///< facets of the new cells that become kept
  std::vector<Index> patches; ///< SimplexMesh::patch() of each new kept facet; empty: None
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

/// Edits a mesh through two operations, which are journalled while a transaction is open:
///  - replace(): exchange a cavity (some cells) for other cells with the same boundary;
///  - movePoint().
/// The journal covers cells, adjacency, kept facets and edges, regions, parents, points and their
/// stamps, places on the surface, and the attachments (values at points that are stored elsewhere,
/// such as the metric). rollback() restores all of it, bit for bit. Qualities are passed in by the
/// caller, who has just computed them to decide.
///
/// The editor does not look at geometry. Whether the new cells are positive or better is up to the
/// caller; debug builds assert that they fill the boundary of the cavity exactly.
///
/// Several editors may work on one mesh at the same time if each touches only cells all of whose
/// points it owns (Point::owner, setOwner()). Each then takes free slots only from its own pool.
template <int D>
class MeshEditor
{
public:
  using Mesh = SimplexMesh<D>;

  /// Scans the mesh for the latest mark and stamp; linear.
  explicit MeshEditor(Mesh& mesh);
  /// Another editor of the same mesh, with the same attachments, clock and marks; O(1).
  static MeshEditor beside(const MeshEditor& other);

  Mesh& mesh() { return *this->mesh_; }
  const Mesh& mesh() const { return *this->mesh_; }

  /// From now on the values of `attachment` follow the points, and the journal covers them. It must
  /// outlive the editor. Not within a transaction.
  void attach(PointAttachment<D>& attachment);
  /// Ends the attachment. Not within a transaction.
  void detach(PointAttachment<D>& attachment);

  /// Replaces the cells `cavity` by `cells`, whose qualities are `qualities`. New cells are
  /// numbered positively, and use points of the cavity or from addPoint(). Their ids are in
  /// created(), in the order of `cells`. Points of the cavity that no new cell uses die; they must
  /// be interior to it. The cavity has no kept facet inside, and all its cells have one region. A
  /// new cell takes its parent from the cavity cell behind its facet.
  /// With `change`, the boundary of the cavity may differ where it is the surface. The cavity may
  /// then have several regions, with the kept facets between them inside.
  /// Returns false, with nothing changed, only if the editor's pool has too few slots.
  bool replace(const std::vector<Index>& cavity, const std::vector<Simplex<D>>& cells,
    const std::vector<double>& qualities, const KeptChange<D>* change = nullptr);
  const std::vector<Index>& created() const { return this->created_; }

  /// A new point at x that no cell uses yet; None if the editor's pool has no slot. Attachments get
  /// a value for it when movePoint() places it.
  Index addPoint(const Vec<D>& x);
  /// The same, with values at once: `near` is a point near x, where attachments begin to look.
  /// `place`: on the surface, if the point slides; see setPlace().
  Index addPoint(const Vec<D>& x, Index near, const Place& place = {});

  /// Moves a point, and stamps it unless it is there already. Attachments follow. `near`: a point
  /// near x, for a new point without values; None: the point itself. The caller must set the
  /// qualities of its star.
  void movePoint(Index p, const Vec<D>& x, Index near = None);

  /// Sets the place of the point on the surface; changes nothing else. The first call must not come
  /// from the editor of a chunk, unless makeRoomForPlaces() was called before.
  void setPlace(Index p, const Place& place);

  /// Sets the patch of the surface to which the kept facet i of cell c belongs, on both sides of
  /// it. The first call must be outside of transactions.
  void setPatch(Index c, int i, Index patch);

  /// Keeps the edge from a to b of cell c: marks it in all cells around it that can be reached over
  /// facets. Outside of transactions.
  void keepEdge(Index c, Index a, Index b);
  /// Takes the mark from edge e of cell c, of this cell alone. Outside of transactions.
  void giveUpEdge(Index c, int e);

  /// Makes room for the places of all points: setPlace() may then be called by editors of chunks.
  void makeRoomForPlaces();

  void setQuality(Index c, double q);
  /// Stamps all points of these cells with a new time: their stars have changed.
  void stamp(const std::vector<Index>& cells);
  /// Sets CellData::stamp and level: time and effort of the last failed try. Not journalled.
  void setFailed(Index c, std::uint32_t stamp, int level)
  {
    this->mesh_->cellData_[c].stamp = stamp;
    this->mesh_->cellData_[c].level = static_cast<std::uint8_t>(level);
  }

  /// Set Point::moveFailed and removeFailed. Not journalled.
  void setMoveFailed(Index p, std::uint32_t stamp) { this->mesh_->points_[p].moveFailed = stamp; }
  void setRemoveFailed(Index p, std::uint32_t stamp)
  {
    this->mesh_->points_[p].removeFailed = stamp;
  }

  /// The time of the latest edit. Points around an edit carry it as their stamp.
  std::uint32_t clock() const { return this->clock_; }
  void setClock(std::uint32_t clock) { this->clock_ = clock; }

  // --- transactions
  /// Opens a transaction, and returns its place in the journal. Transactions may be nested.
  std::size_t begin();
  /// Keeps what was done since `place`. Empties the journal if this is the outermost transaction.
  void commit(std::size_t place);
  bool inTransaction() const { return this->depth_ > 0; }
  /// Undoes what was done since `place`, in reverse, bit for bit.
  void rollback(std::size_t place);

  // --- scratch marks on cells: O(1) sets of cells
  /// Starts an empty set; the previous one is lost.
  std::uint32_t newMark() { return ++this->mark_; }
  bool isMarked(Index c, std::uint32_t m) const { return this->mesh_->cellData_[c].mark == m; }
  void setMark(Index c, std::uint32_t m) const { this->mesh_->cellData_[c].mark = m; }
  std::uint32_t lastMark() const { return this->mark_; }
  void setLastMark(std::uint32_t m) { this->mark_ = m; }

  // --- parallel passes
  /// Restricts the editor to cells all of whose points have this owner, and to the slots of
  /// freeCells() and freePoints(). None (the default): all cells; the mesh grows as needed.
  void setOwner(Index owner) { this->owner_ = owner; }
  bool owns(Index c) const
  {
    if (this->owner_ == None)
    {
      return true;
    }
    // Reads only nodes and owners: no editor changes those of a cell across a border.
    for (Index p : this->mesh_->cells_[c].nodes)
    {
      if (this->mesh_->points_[p].owner != this->owner_)
      {
        this->isHeldUp_ = true;
        return false;
      }
    }
    return true;
  }
  /// Whether a border played a part: something was refused since the last resetHeldUp(), because
  /// another editor owns it or because the pool was empty. Such a failure says nothing about the
  /// mesh.
  bool isHeldUp() const { return this->isHeldUp_; }
  void resetHeldUp() { this->isHeldUp_ = false; }
  void setPointOwner(Index p, Index owner) { this->mesh_->points_[p].owner = owner; }
  /// Dead slots that this editor may use; it takes them from the back.
  std::vector<Index>& freeCells() { return this->freeCells_; }
  std::vector<Index>& freePoints() { return this->freePoints_; }
  /// Appends n dead slots to the mesh and adds them to the pool. Not while other editors work.
  void growCells(Index n);
  void growPoints(Index n);

  /// The star of p, as SimplexMesh::star(), but faster, since it uses marks. Returns false, with
  /// `star` incomplete, as soon as it meets a cell that the editor does not own.
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
  /// The link across one facet. A cell at the border of the owned ones is never saved as a whole:
  /// its other facets may belong to another editor.
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
  /// A facet in the refilling of a cavity: on its boundary, or between new cells.
  struct OpenFacet
  {
    Facet<D> key;  // sorted
    Index outside; // handle across it (outer cell or first new cell); None: surface
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
  mutable bool isHeldUp_ = false;
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
