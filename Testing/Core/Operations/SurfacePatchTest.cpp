// SPDX-License-Identifier: BSD-3-Clause
// A flat patch of the surface of tetrahedra that takes part: a node slides on it, an edge is
// swapped, a node is contracted into its neighbour, an edge is divided; each done, and undone to
// the bit.
#include "Edit/Judge.h"
#include "MeshSnapshot.h"
#include "Operations/EdgeContraction.h"
#include "Operations/EdgeRemoval.h"
#include "Operations/EdgeSplit.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
using Shape = MeanEdgeShape<3>;

/// The plane z = 0 is a patch; points of it that have a place slide. Everything else is kept.
class Floor final : public Surface<3>
{
public:
  Vec<3> at(Index, double) const override { return Vec<3>::Zero(); }
  Place project(const Place& place, const Vec<3>& x, Vec<3>& there) const override
  {
    there = Vec<3>(x[0], x[1], 0.0);
    return place;
  }
  int tangents(const SimplexMesh<3>&, const std::vector<Index>&, Index,
    std::array<Vec<3>, 3>& basis) const override
  {
    basis[0] = Vec<3>::UnitX();
    basis[1] = Vec<3>::UnitY();
    return 2;
  }
  std::optional<Span> span(const SimplexMesh<3>&, Index, Index) const override
  {
    return std::nullopt;
  }
  std::optional<SlidingRange> range(
    const SimplexMesh<3>&, const std::vector<Index>&, Index) const override
  {
    return std::nullopt;
  }
  bool mayDivide(
    const SimplexMesh<3>& mesh, const std::vector<Index>&, Index a, Index b) const override
  {
    return slides(mesh, a) && isOn(mesh, b);
  }
  bool maySwap(const SimplexMesh<3>&, Index patch, Index other) const override
  {
    return patch == 7 && other == 7;
  }
  bool mayJoin(
    const SimplexMesh<3>& mesh, const std::vector<Index>&, Index v, Index u) const override
  {
    return slides(mesh, v) && isOn(mesh, u);
  }

private:
  static bool isOn(const SimplexMesh<3>& mesh, Index p) { return mesh.point(p)[2] == 0.0; }
  static bool slides(const SimplexMesh<3>& mesh, Index p)
  {
    return mesh.freedom(p) == Freedom::Patch;
  }
};

/// A cube whose bottom takes part.
class SurfacePatch : public ::testing::Test
{
protected:
  SurfacePatch()
    : mesh(buildMesh(jitteredGrid<3>(4, 0.1)))
    , editor(mesh)
    , model(mesh, metric, 0.0)
    , judge(editor, model, switches, &floor)
  {
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      this->editor.setQuality(c, this->model(this->mesh.nodes(c)));
    }
    std::map<Index, bool> onlyFloor; // points of the floor: are all their kept facets there?
    this->forKept(
      [&](Index c, int i)
      {
        const Facet<3> f = this->mesh.facet(c, i);
        const bool isFloor = std::all_of(
          f.begin(), f.end(), [&](Index p) { return this->mesh.point(p)[2] == 0.0; });
        this->editor.setPatch(c, i, isFloor ? 7 : 8);
        for (Index p : f)
        {
          onlyFloor.emplace(p, true).first->second &= isFloor;
        }
      });
    for (const auto& [p, isInside] : onlyFloor)
    {
      if (isInside)
      {
        this->editor.setPlace(p, { Freedom::Patch, 7, 0.0 });
        this->sliding.push_back(p);
      }
    }
    this->judge.growth.left = AnyGrowth;
    this->volume = this->mesh.volume();
    this->euler = eulerCharacteristic(this->mesh);
  }

  template <class F>
  void forKept(F&& f) const
  {
    for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
    {
      for (int i = 0; i < 4 && this->mesh.isAlive(c); ++i)
      {
        if (this->mesh.isKept(c, i))
        {
          f(c, i);
        }
      }
    }
  }

  /// The floor is still what it was, and the mesh a mesh.
  void check() const
  {
    expectSound(this->mesh);
    EXPECT_NEAR(this->mesh.volume(), this->volume, 1e-14);
    EXPECT_EQ(eulerCharacteristic(this->mesh), this->euler);
    double area = 0.0;
    this->forKept(
      [&](Index c, int i)
      {
        const Facet<3> f = this->mesh.facet(c, i);
        const bool isFloor = std::all_of(
          f.begin(), f.end(), [&](Index p) { return this->mesh.point(p)[2] == 0.0; });
        EXPECT_EQ(this->mesh.patch(c, i), isFloor ? 7 : 8);
        const Vec<3>&a = this->mesh.point(f[0]), &b = this->mesh.point(f[1]);
        area += isFloor ? 0.5 * (b - a).cross(this->mesh.point(f[2]) - a).norm() : 0.0;
      });
    EXPECT_NEAR(area, 1.0, 1e-14);
  }

  /// Has the judge make the change, checks, and undoes it.
  void doAndUndo(Proposal<3>& p)
  {
    const Snapshot<3> before(this->editor);
    const auto mark = this->judge.begin();
    ASSERT_TRUE(this->judge.accept(p));
    this->check();
    EXPECT_FALSE(Snapshot<3>(this->editor) == before);
    this->judge.rollback(mark);
    EXPECT_TRUE(Snapshot<3>(this->editor) == before);
    // and once more, to stay
    ASSERT_TRUE(this->judge.accept(p));
    this->check();
  }

  SimplexMesh<3> mesh;
  MeshEditor<3> editor;
  NodalMetric<3> metric;
  QualityModel<3, Shape> model;
  Switches switches;
  Floor floor;
  Judge<3, Shape> judge;
  std::vector<Index> sliding;
  double volume = 0.0;
  long euler = 0;
};

TEST_F(SurfacePatch, NodesOfThePatchHaveAPlace)
{
  EXPECT_EQ(this->sliding.size(), 9u);
  for (Index p : this->sliding)
  {
    EXPECT_EQ(this->mesh.freedom(p), Freedom::Patch);
    EXPECT_FALSE(this->mesh.isFree(p));
    std::array<Vec<3>, 3> basis;
    EXPECT_EQ(this->floor.tangents(this->mesh, {}, p, basis), 2);
  }
  this->check();
}

TEST_F(SurfacePatch, ANodeSlides)
{
  for (Index v : this->sliding)
  {
    Proposal<3> p;
    this->editor.star(v, p.cavity);
    Vec<3> there;
    const Vec<3> wanted = this->mesh.point(v) + Vec<3>(0.02, -0.03, 0.05);
    const Place place = this->floor.project(this->mesh.place(v), wanted, there);
    p.moves.push_back({ v, there, place });
    p.least = 0.0;
    this->doAndUndo(p);
    EXPECT_EQ(this->mesh.point(v), there);
  }
}

/// Each edge of the patch whose two tetrahedra on the surface can be filled the other way.
TEST_F(SurfacePatch, EdgesAreSwapped)
{
  EdgeRemoval<3, Shape> removal;
  int pairs = 0, more = 0;
  for (Index c = 0; c < this->mesh.numberOfCellSlots(); ++c)
  {
    for (int e = 0; e < 6 && this->mesh.isAlive(c); ++e)
    {
      const Index a = this->mesh.nodes(c)[Local<3>::edges[e][0]];
      const Index b = this->mesh.nodes(c)[Local<3>::edges[e][1]];
      if (this->mesh.point(a)[2] != 0.0 || this->mesh.point(b)[2] != 0.0)
      {
        continue;
      }
      EXPECT_FALSE(
        removal.propose(this->editor, this->model, c, e, 0.0) > 0.0); // kept without a surface
      // whatever quality it gives, as long as all is positive
      std::vector<Index> ring;
      this->mesh.ring(c, a, b, true, ring);
      std::vector<double> stored;
      for (Index k : ring)
      {
        stored.push_back(this->mesh.quality(k));
        this->editor.setQuality(k, 0.0);
      }
      const double q = removal.propose(this->editor, this->model, c, e, 0.0, &this->floor);
      Proposal<3> p;
      if (q > 1e-6)
      {
        removal.fill(p, this->mesh);
      }
      for (std::size_t k = 0; k < ring.size(); ++k)
      {
        this->editor.setQuality(ring[k], stored[k]);
      }
      if (!(q > 1e-6))
      {
        continue;
      }
      p.newWorst = q;
      p.least = 0.0;
      EXPECT_EQ(p.kept.gone.size(), 2u);
      EXPECT_EQ(p.cells.size(), 2 * p.cavity.size() - 2);
      ++(p.cavity.size() == 2 ? pairs : more);
      this->doAndUndo(p);
    }
  }
  EXPECT_GT(pairs, 0);
  EXPECT_GT(more, 0);
}

TEST_F(SurfacePatch, ANodeIsContracted)
{
  int done = 0;
  for (Index v : this->sliding)
  {
    std::vector<Index> star;
    this->editor.star(v, star);
    for (Index c : star)
    {
      for (Index u : this->mesh.nodes(c))
      {
        Proposal<3> p;
        if (u == v || !proposeContraction<3>(this->editor, &this->floor, v, u, p))
        {
          continue;
        }
        EXPECT_EQ(this->mesh.point(u)[2], 0.0);
        p.least = 0.0;
        if (this->judge.measure(p) && this->mesh.isPointAlive(v))
        {
          this->doAndUndo(p);
          EXPECT_FALSE(this->mesh.isPointAlive(v));
          ++done;
          break;
        }
      }
      if (!this->mesh.isPointAlive(v))
      {
        break;
      }
    }
  }
  EXPECT_GE(done, 3);
}

TEST_F(SurfacePatch, AnEdgeIsDivided)
{
  int done = 0;
  for (Index c = 0; c < 300 && done < 20; ++c)
  {
    for (int e = 0; e < 6 && this->mesh.isAlive(c); ++e)
    {
      const Index a = this->mesh.nodes(c)[Local<3>::edges[e][0]];
      const Index b = this->mesh.nodes(c)[Local<3>::edges[e][1]];
      if (!this->floor.mayDivide(this->mesh, {}, a, b))
      {
        continue;
      }
      const Snapshot<3> before(this->editor);
      for (bool stays : { false, true })
      {
        const auto mark = this->judge.begin();
        const Vec<3> x = 0.5 * (this->mesh.point(a) + this->mesh.point(b));
        const Index m = this->editor.addPoint(x);
        this->editor.setPlace(m, { Freedom::Patch, 7, 0.0 });
        Proposal<3> p;
        ASSERT_TRUE(proposeSplit<3>(this->editor, &this->floor, { c, a, b, m }, p));
        p.least = 0.0;
        ASSERT_TRUE(this->judge.measure(p) && this->judge.accept(p));
        this->check();
        EXPECT_EQ(this->mesh.freedom(m), Freedom::Patch);
        stays ? this->judge.commit(mark) : this->judge.rollback(mark);
        EXPECT_TRUE(stays || Snapshot<3>(this->editor) == before);
      }
      ++done;
      break;
    }
  }
  EXPECT_GE(done, 10);
}
}
