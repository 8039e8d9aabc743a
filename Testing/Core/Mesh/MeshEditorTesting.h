// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the editor share: cavities made and replaced at random, and the state that
// undoing must restore.
#ifndef meshopt_Testing_MeshEditorTesting_h
#define meshopt_Testing_MeshEditorTesting_h

#include "MeshSnapshot.h"
#include "TestMeshes.h"

#include <map>

namespace meshopt
{
template <int D>
double volumeOf(const SimplexMesh<D>& mesh, const Simplex<D>& cell)
{
  Corners<D> x;
  for (int i = 0; i <= D; ++i)
  {
    x[i] = mesh.point(cell[i]);
  }
  return signedVolume(x);
}

/// Facets of the cavity that only one of its cells has, each such that (facet, node) is positive.
template <int D>
std::vector<Facet<D>> boundary(const SimplexMesh<D>& mesh, const std::vector<Index>& cavity)
{
  std::vector<Facet<D>> facets;
  for (Index c : cavity)
  {
    for (int i = 0; i <= D; ++i)
    {
      const Index h = mesh.adjacent(c, i);
      if (h == None || std::find(cavity.begin(), cavity.end(), mesh.cellOf(h)) == cavity.end())
      {
        facets.push_back(mesh.facet(c, i));
      }
    }
  }
  return facets;
}

/// The cells that join the boundary of the cavity to p; empty if one is not positive. Facets that
/// have p themselves are left out.
template <int D>
std::vector<Simplex<D>> joined(
  const SimplexMesh<D>& mesh, const std::vector<Index>& cavity, Index p)
{
  std::vector<Simplex<D>> cells;
  for (const Facet<D>& f : boundary<D>(mesh, cavity))
  {
    if (std::find(f.begin(), f.end(), p) != f.end())
    {
      continue;
    }
    Simplex<D> cell;
    std::copy(f.begin(), f.end(), cell.begin());
    cell[D] = p;
    if (!(volumeOf<D>(mesh, cell) > 1e-9))
    {
      return {};
    }
    cells.push_back(cell);
  }
  return cells;
}

template <int D>
Facet<D> sorted(Facet<D> f)
{
  std::sort(f.begin(), f.end());
  return f;
}

/// replace(), and all that it promises.
template <int D>
void replaceAndCheck(MeshEditor<D>& editor, const std::vector<Index>& cavity,
  const std::vector<Simplex<D>>& cells, bool audit = true)
{
  const SimplexMesh<D>& mesh = editor.mesh();
  struct Side
  {
    Index outside, parent;
    bool kept;
  };
  std::map<Facet<D>, Side> sides;
  std::set<std::array<Index, 2>> keptEdges;
  std::set<Index> points;
  for (Index c : cavity)
  {
    points.insert(mesh.nodes(c).begin(), mesh.nodes(c).end());
    for (int i = 0; i <= D; ++i)
    {
      const Index h = mesh.adjacent(c, i);
      if (h == None || std::find(cavity.begin(), cavity.end(), mesh.cellOf(h)) == cavity.end())
      {
        sides[sorted<D>(mesh.facet(c, i))] = { h, mesh.parent(c), mesh.isKept(c, i) };
      }
    }
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      const Index a = mesh.nodes(c)[Local<D>::edges[e][0]];
      const Index b = mesh.nodes(c)[Local<D>::edges[e][1]];
      if (mesh.isEdgeKeptByItself(c, e))
      {
        keptEdges.insert({ std::min(a, b), std::max(a, b) });
      }
    }
  }
  const Index region = mesh.region(cavity[0]), parent = mesh.parent(cavity[0]);
  const Index cellsBefore = mesh.countCells();
  const std::uint32_t clock = editor.clock();
  std::vector<double> qualities;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    qualities.push_back(0.25 + 0.01 * double(k));
  }

  ASSERT_TRUE(editor.replace(cavity, cells, qualities));

  ASSERT_EQ(editor.created().size(), cells.size());
  EXPECT_EQ(mesh.countCells(), cellsBefore + Index(cells.size()) - Index(cavity.size()));
  EXPECT_GT(editor.clock(), clock);
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const Index c = editor.created()[k];
    EXPECT_TRUE(mesh.isAlive(c));
    EXPECT_EQ(mesh.nodes(c), cells[k]);
    EXPECT_EQ(mesh.quality(c), qualities[k]);
    EXPECT_EQ(mesh.region(c), region);
    EXPECT_EQ(mesh.cellData(c).stamp, 0u);
    std::set<Index> parents;
    for (int i = 0; i <= D; ++i)
    {
      const auto side = sides.find(sorted<D>(mesh.facet(c, i)));
      if (side == sides.end())
      {
        EXPECT_FALSE(mesh.isKept(c, i));
        continue;
      }
      parents.insert(side->second.parent);
      EXPECT_EQ(mesh.adjacent(c, i), side->second.outside);
      EXPECT_EQ(mesh.isKept(c, i), side->second.kept);
      sides.erase(side);
    }
    EXPECT_TRUE(parents.empty() ? mesh.parent(c) == parent : parents.count(mesh.parent(c)) == 1);
    for (int e = 0; e < Local<D>::numberOfEdges; ++e)
    {
      const Index a = cells[k][Local<D>::edges[e][0]], b = cells[k][Local<D>::edges[e][1]];
      EXPECT_EQ(
        mesh.isEdgeKeptByItself(c, e), keptEdges.count({ std::min(a, b), std::max(a, b) }) == 1);
    }
    for (Index p : cells[k])
    {
      points.erase(p);
      EXPECT_EQ(mesh.pointData(p).stamp, editor.clock());
    }
  }
  EXPECT_TRUE(sides.empty());
  for (Index p : points) // what is left has vanished
  {
    EXPECT_FALSE(mesh.isPointAlive(p));
    EXPECT_EQ(mesh.cellOfPoint(p), None);
    const auto& pool = editor.freePoints();
    EXPECT_EQ(std::count(pool.begin(), pool.end(), p), p >= mesh.numberOfInputPoints());
  }
  if (audit)
  {
    expectSound(mesh);
  }
}

/// One random edit that keeps all cells positive (or none, if what it drew is not possible).
template <int D>
class RandomEdits
{
public:
  RandomEdits(MeshEditor<D>& editor, unsigned seed)
    : editor_(editor)
    , random_(seed)
  {
  }

  int below(int n) { return std::min(n - 1, int(0.5 * (this->random_() + 1.0) * n)); }

  void edit()
  {
    const int kind = this->below(6);
    const Index c = this->someCell();
    kind == 0     ? this->insert(c)
      : kind == 1 ? this->contract(c)
      : kind == 2 ? this->move(c)
      : kind == 3 ? this->reconnect(c)
      : kind == 4 ? this->stampAndRate(c)
                  : this->addAndDrop(c);
  }
  std::array<int, 5> done{};

private:
  const SimplexMesh<D>& mesh() const { return this->editor_.mesh(); }

  Index someCell()
  {
    while (true)
    {
      const Index c = this->below(this->mesh().numberOfCellSlots());
      if (this->mesh().isAlive(c))
      {
        return c;
      }
    }
  }

  Vec<D> centre(Index c) const
  {
    Vec<D> x = Vec<D>::Zero();
    for (Index p : this->mesh().nodes(c))
    {
      x += this->mesh().point(p) / (D + 1);
    }
    return x;
  }

  /// c and what lies across one of its facets that are not kept
  std::vector<Index> pairOf(Index c)
  {
    const int i = this->below(D + 1);
    return this->mesh().isKept(c, i)
      ? std::vector<Index>{ c }
      : std::vector<Index>{ c, this->mesh().cellOf(this->mesh().adjacent(c, i)) };
  }

  void replace(const std::vector<Index>& cavity, const std::vector<Simplex<D>>& cells)
  {
    replaceAndCheck<D>(this->editor_, cavity, cells, false);
  }

  void insert(Index c)
  {
    const std::size_t start = this->editor_.begin();
    const std::vector<Index> cavity = this->pairOf(c);
    const Index p = this->editor_.addPoint(this->centre(c));
    const std::vector<Simplex<D>> cells = joined<D>(this->mesh(), cavity, p);
    if (cells.empty())
    {
      this->editor_.rollback(start);
      return;
    }
    this->replace(cavity, cells);
    this->editor_.commit(start);
    ++this->done[0];
  }

  void contract(Index c)
  {
    const Simplex<D> nodes = this->mesh().nodes(c);
    for (Index v : nodes)
    {
      if (!this->mesh().isFree(v))
      {
        continue;
      }
      std::vector<Index> star;
      this->editor_.star(v, star);
      for (Index u : nodes)
      {
        const std::vector<Simplex<D>> cells = joined<D>(this->mesh(), star, u);
        if (u != v && !cells.empty())
        {
          this->replace(star, cells);
          ++this->done[1];
          return;
        }
      }
    }
  }

  void move(Index c)
  {
    const Index v = this->mesh().nodes(c)[this->below(D + 1)];
    if (!this->mesh().isFree(v))
    {
      return;
    }
    std::vector<Index> star;
    this->editor_.star(v, star);
    const std::size_t start = this->editor_.begin();
    Vec<D> x = this->mesh().point(v);
    for (int d = 0; d < D; ++d)
    {
      x[d] += 0.02 * this->random_();
    }
    this->editor_.movePoint(v, x);
    EXPECT_EQ(this->mesh().point(v), x);
    bool positive = true;
    for (Index s : star)
    {
      positive = positive && volumeOf<D>(this->mesh(), this->mesh().nodes(s)) > 1e-9;
      this->editor_.setQuality(s, this->random_());
    }
    positive ? this->editor_.commit(start) : this->editor_.rollback(start);
    this->done[2] += positive;
  }

  /// 2D: the other diagonal. 3D: two cells for three.
  void reconnect(Index c)
  {
    const std::vector<Index> cavity = this->pairOf(c);
    if (cavity.size() < 2)
    {
      return;
    }
    std::set<Index> apex;
    for (Index k : cavity)
    {
      for (Index p : this->mesh().nodes(k))
      {
        apex.count(p) ? (void)apex.erase(p) : (void)apex.insert(p);
      }
    }
    const std::vector<Simplex<D>> cells = joined<D>(this->mesh(), cavity, *apex.begin());
    if (!cells.empty())
    {
      this->replace(cavity, cells);
      ++this->done[3];
    }
  }

  void stampAndRate(Index c)
  {
    this->editor_.stamp({ c });
    for (Index p : this->mesh().nodes(c))
    {
      EXPECT_EQ(this->mesh().pointData(p).stamp, this->editor_.clock());
    }
    this->editor_.setQuality(c, 0.125);
    EXPECT_EQ(this->mesh().quality(c), 0.125);
  }

  void addAndDrop(Index c)
  {
    const std::size_t start = this->editor_.begin();
    const Index p = this->editor_.addPoint(this->centre(c));
    EXPECT_EQ(this->mesh().point(p), this->centre(c));
    EXPECT_FALSE(this->mesh().isPointAlive(p));
    EXPECT_GE(p, this->mesh().numberOfInputPoints());
    this->editor_.rollback(start);
    ++this->done[4];
  }

  MeshEditor<D>& editor_;
  TestRandom random_;
};

template <int D>
void nested(MeshEditor<D>& editor, RandomEdits<D>& edits, int depth, int& rollbacks)
{
  const Snapshot<D> before(editor);
  const std::size_t place = editor.begin();
  EXPECT_TRUE(editor.inTransaction());
  for (int k = 0; k < 6; ++k)
  {
    edits.edit();
    if (depth > 0 && edits.below(3) == 0)
    {
      nested(editor, edits, depth - 1, rollbacks);
    }
  }
  expectSound(editor.mesh());
  if (edits.below(2) == 0)
  {
    editor.commit(place);
    return;
  }
  editor.rollback(place);
  ++rollbacks;
  EXPECT_TRUE(before == Snapshot<D>(editor)) << "not undone at depth " << depth;
}
}

#endif
