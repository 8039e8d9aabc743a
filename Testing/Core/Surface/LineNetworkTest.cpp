// SPDX-License-Identifier: BSD-3-Clause
// Lines, their corners and chains: against the turns that lines were made of, and by hand.
#include "Surface/LineNetwork.h"
#include "PlaneMeshes.h"

using namespace meshopt;

namespace
{
using Line = std::array<Index, 2>;

/// An open line of unit steps that turns by so many degrees at each inner point; `flip`: which of
/// its lines are stored the other way round.
LineNetwork lineOfTurns(const std::vector<double>& turns, unsigned flip = 0)
{
  LineNetwork network;
  network.points = { Vec<2>(0.3, -0.2) };
  double angle = 0.4;
  for (std::size_t k = 0; k <= turns.size(); ++k)
  {
    const Vec<2> x = network.points.back() + Vec<2>(std::cos(angle), std::sin(angle));
    network.points.push_back(x);
    const Index p = static_cast<Index>(k);
    network.lines.push_back((flip >> k) & 1u ? Line{ p + 1, p } : Line{ p, p + 1 });
    angle += k < turns.size() ? turns[k] * Pi / 180.0 : 0.0;
  }
  return network;
}

std::vector<std::uint8_t> cornersBy(LineNetwork network, double angle)
{
  markCorners(network, angle);
  return network.corners;
}

std::vector<std::uint8_t> kinks(LineNetwork network)
{
  markCorners(network, 60.0);
  markKinks(network);
  return network.corners;
}

using Flags = std::vector<std::uint8_t>;
}

TEST(LineNetwork, KeptLinesAreThoseAtOneCellOrTwoRegions)
{
  MeshInput<2> in = jitteredGrid<2>(6, 0.2);
  splitRegions(in);
  in.keptFacets = { { 8, 9 } };
  in.fixedPoints.assign(in.points.size(), 0);
  in.fixedPoints[3] = in.fixedPoints[24] = 1;
  std::map<std::set<Index>, std::set<Index>> cells; // of each edge
  for (std::size_t c = 0; c < in.cells.size(); ++c)
  {
    for (const auto& e : Local<2>::edges)
    {
      cells[{ in.cells[c][e[0]], in.cells[c][e[1]] }].insert(static_cast<Index>(c));
    }
  }
  std::set<std::set<Index>> wanted{ { 8, 9 } };
  for (const auto& [edge, both] : cells)
  {
    if (both.size() == 1 || in.regions[*both.begin()] != in.regions[*both.rbegin()])
    {
      wanted.insert(edge);
    }
  }
  const LineNetwork network = keptLines(buildMesh(in));
  std::set<std::set<Index>> found;
  for (const Line& l : network.lines)
  {
    EXPECT_TRUE(found.insert({ l[0], l[1] }).second) << "each of them once";
  }
  EXPECT_EQ(found, wanted);
  EXPECT_EQ(network.points, in.points);
  EXPECT_EQ(network.corners, in.fixedPoints);
}

TEST(LineNetwork, CornersAreWhereLinesTurnByMoreThanTheAngle)
{
  TestRandom random(3);
  for (int run = 0; run < 200; ++run)
  {
    std::vector<double> turns;
    for (int k = 0; k < 6; ++k)
    {
      turns.push_back(178.0 * random());
    }
    const LineNetwork network = lineOfTurns(turns, static_cast<unsigned>(run));
    const double angle = 90.0 + 89.0 * random();
    Flags wanted{ 1 }; // an end of one line
    for (double turn : turns)
    {
      wanted.push_back(std::fabs(turn) > angle);
    }
    wanted.push_back(1);
    EXPECT_EQ(cornersBy(network, angle), wanted) << angle;
  }
}

TEST(LineNetwork, LinesThatTurnBackAreCornersForAnyAngle)
{
  for (double angle : { 179.0, 180.0, 1000.0 })
  {
    EXPECT_EQ(cornersBy(lineOfTurns({ 178.5, 180.0, -179.5 }), angle), Flags({ 1, 0, 1, 1, 1 }));
  }
}

TEST(LineNetwork, CornersAreWhereNotTwoLinesMeet)
{
  LineNetwork star; // three lines, one of them of two parts; and a point without a line
  star.points = { { 0, 0 }, { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, 2 }, { 5, 5 } };
  star.lines = { { 0, 1 }, { 2, 0 }, { 0, 3 }, { 4, 3 } };
  EXPECT_EQ(cornersBy(star, 45.0), Flags({ 1, 1, 1, 0, 1, 0 }));
  star.corners = { 0, 0, 0, 1, 0, 1 }; // those that are marked stay so
  EXPECT_EQ(cornersBy(star, 45.0), Flags({ 1, 1, 1, 1, 1, 1 }));
}

TEST(LineNetwork, TheEndsOfALineWithoutLengthAreCorners)
{
  for (double gap : { 0.0, 1e-12 })
  {
    LineNetwork network = lineOfTurns({ 0, 0, 0, 0 });
    network.points[3] = (1.0 - gap) * network.points[2] + gap * network.points[3];
    EXPECT_EQ(cornersBy(network, 45.0), Flags({ 1, 0, 1, 1, 0, 1 }));
  }
}

TEST(LineNetwork, KinksAreSingleTurns)
{
  EXPECT_EQ(kinks(lineOfTurns({ 0, 20, 0 })), Flags({ 1, 0, 1, 0, 1 }));
  EXPECT_EQ(kinks(lineOfTurns({ 0, -20, 0 })), Flags({ 1, 0, 1, 0, 1 }));
  EXPECT_EQ(kinks(lineOfTurns({ 0, 9, 0 })), Flags({ 1, 0, 0, 0, 1 }));    // too little
  EXPECT_EQ(kinks(lineOfTurns({ 20, 20, 20 })), Flags({ 1, 0, 0, 0, 1 })); // a curve
  EXPECT_EQ(kinks(lineOfTurns({ 20, -20, 0 })), Flags({ 1, 1, 1, 0, 1 })); // a step
  EXPECT_EQ(kinks(lineOfTurns({ 0, 20, 4 })), Flags({ 1, 0, 1, 0, 1 }));   // a fifth as much
  EXPECT_EQ(kinks(lineOfTurns({ 0, 20, 6 })), Flags({ 1, 0, 0, 0, 1 }));   // three tenths
  EXPECT_EQ(kinks(lineOfTurns({ 80, 20, 80 })), Flags({ 1, 1, 1, 1, 1 })); // corners do not count
  EXPECT_EQ(kinks(loop(circle(16))), Flags(16, 0));
}

TEST(LineNetwork, KinksFollowFromTheTurns)
{
  TestRandom random(9);
  int count = 0;
  for (int run = 0; run < 500; ++run)
  {
    std::vector<double> turns;
    for (int k = 0; k < 7; ++k)
    {
      turns.push_back(40.0 * random() * (random() > 0.0));
    }
    Flags wanted{ 1 };
    for (std::size_t k = 0; k < turns.size(); ++k)
    {
      const double before = k > 0 ? turns[k - 1] : 0.0;
      const double after = k + 1 < turns.size() ? turns[k + 1] : 0.0;
      const bool isKink = std::fabs(turns[k]) * Pi / 180.0 > 0.17 && before / turns[k] <= 0.25 &&
        after / turns[k] <= 0.25;
      wanted.push_back(isKink);
      count += isKink;
    }
    wanted.push_back(1);
    EXPECT_EQ(kinks(lineOfTurns(turns, static_cast<unsigned>(run))), wanted);
  }
  EXPECT_GT(count, 300);
}

TEST(LineNetwork, AClosedLineIsOneChain)
{
  LineNetwork network = loop(circle(12));
  markCorners(network, 45.0);
  std::vector<LineChain> all = chains(network);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(all[0].isClosed);
  EXPECT_EQ(all[0].points.size(), 12u); // the first one is not there again

  network.corners[5] = 1; // from the corner around to itself
  all = chains(network);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_FALSE(all[0].isClosed);
  EXPECT_EQ(all[0].points.size(), 13u);
  EXPECT_EQ(all[0].points.front(), 5);
  EXPECT_EQ(all[0].points.back(), 5);

  network.corners[8] = 1;
  all = chains(network);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].points.size() + all[1].points.size(), 14u);
}

/// Grids of lines some of which are missing: all lines are in one chain each, from corner
/// to corner or closed.
TEST(LineNetwork, EveryLineIsInOneChain)
{
  TestRandom random(4);
  int closed = 0;
  for (int run = 0; run < 1000; ++run)
  {
    LineNetwork network;
    const int n = 4;
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        network.points.emplace_back(i, j);
        const Index p = static_cast<Index>(j * n + i);
        if (i + 1 < n && random() > 0.1)
        {
          network.lines.push_back({ p, p + 1 });
        }
        if (j + 1 < n && random() > 0.1)
        {
          network.lines.push_back({ p + n, p });
        }
      }
    }
    markCorners(network, 100.0);
    std::multiset<std::set<Index>> found, wanted;
    for (const Line& l : network.lines)
    {
      wanted.insert({ l[0], l[1] });
    }
    bool seenClosed = false;
    Index last = None; // first point of the chain before
    for (const LineChain& chain : chains(network))
    {
      const std::vector<Index>& p = chain.points;
      for (std::size_t k = 1; k < p.size(); ++k)
      {
        found.insert({ p[k - 1], p[k] });
      }
      if (chain.isClosed)
      {
        ++closed;
        found.insert({ p.back(), p.front() });
      }
      for (std::size_t k = 0; k < p.size(); ++k)
      {
        const bool isEnd = !chain.isClosed && (k == 0 || k + 1 == p.size());
        EXPECT_EQ(network.corners[p[k]] != 0, isEnd);
      }
      EXPECT_TRUE(chain.isClosed || !seenClosed) << "those that begin at corners come first";
      EXPECT_TRUE(chain.isClosed != seenClosed || last <= p.front());
      seenClosed = chain.isClosed;
      last = p.front();
    }
    EXPECT_EQ(found, wanted);
  }
  EXPECT_GT(closed, 10);
}
