// SPDX-License-Identifier: BSD-3-Clause
// Which piece of curve joins two nodes, also where corners have become one: by hand, and for random
// networks by a search of all pieces.
#include "Surface/CurvePieces.h"

#include "TestMeshes.h"

using namespace meshopt;

namespace
{
/// A piece from corner to corner, with parameters that tell which piece it is.
CurvePiece piece(Index curve, Index from, Index to, double low = 0.0, double high = 1.0)
{
  CurvePiece result;
  result.curve = curve;
  result.ends = { from, to };
  result.range = { low, high };
  return result;
}

CurvePiece closedPiece(Index curve, double period)
{
  CurvePiece result;
  result.curve = curve;
  result.period = period;
  result.range = { 0.0, period };
  return result;
}

Place onPiece(Index part, double parameter) { return { Freedom::Curve, part, parameter }; }
const Place AtCorner; ///< fixed

void expectSpan(const std::optional<Span>& span, Index part, double from, double to)
{
  ASSERT_TRUE(span);
  EXPECT_EQ(span->part, part);
  EXPECT_NEAR(span->from, from, 1e-15);
  EXPECT_NEAR(span->to, to, 1e-15);
}

CurvePieces joined(const std::vector<CurvePiece>& all)
{
  CurvePieces pieces;
  for (const CurvePiece& p : all)
  {
    pieces.add(p);
  }
  pieces.join();
  return pieces;
}
}

// ---- spans --------------------------------------------------------------------------------------

/// A path 1 - 2 - 3 of two pieces; nodes 10 and up slide.
TEST(CurvePieces, SpansOfAPath)
{
  const CurvePieces pieces = joined({ piece(0, 1, 2, 0.0, 4.0), piece(0, 2, 3, 4.0, 9.0) });
  expectSpan(pieces.span(10, onPiece(0, 1.0), 11, onPiece(0, 3.0)), 0, 1.0, 3.0);
  expectSpan(pieces.span(11, onPiece(0, 3.0), 10, onPiece(0, 1.0)), 0, 3.0, 1.0);
  expectSpan(pieces.span(10, onPiece(0, 1.0), 1, AtCorner), 0, 1.0, 0.0);
  expectSpan(pieces.span(2, AtCorner, 10, onPiece(0, 1.0)), 0, 4.0, 1.0); // 2 as the end of piece 0
  expectSpan(pieces.span(2, AtCorner, 12, onPiece(1, 6.0)), 1, 4.0, 6.0); // and as that of piece 1
  expectSpan(pieces.span(2, AtCorner, 3, AtCorner), 1, 4.0, 9.0);
  expectSpan(pieces.span(3, AtCorner, 2, AtCorner), 1, 9.0, 4.0);
  EXPECT_FALSE(pieces.span(10, onPiece(0, 1.0), 12, onPiece(1, 6.0))); // of two pieces
  EXPECT_FALSE(pieces.span(10, onPiece(0, 1.0), 3, AtCorner));         // not an end of it
  EXPECT_FALSE(pieces.span(1, AtCorner, 3, AtCorner));
  EXPECT_FALSE(pieces.span(1, AtCorner, 99, AtCorner)); // a fixed node elsewhere
}

/// On a closed piece the shorter way round: the difference is at most half of the period, and the
/// end is the same point.
TEST(CurvePieces, SpansOfAClosedPieceTakeTheShorterWay)
{
  constexpr double period = 8.0;
  const CurvePieces pieces = joined({ closedPiece(0, period) });
  for (double from = 0.25; from < period; from += 0.5)
  {
    for (double to = 0.0; to < period; to += 0.5)
    {
      const auto span = pieces.span(10, onPiece(0, from), 11, onPiece(0, to));
      ASSERT_TRUE(span);
      EXPECT_EQ(span->from, from);
      EXPECT_LE(std::fabs(span->to - from), 0.5 * period);
      EXPECT_EQ(std::remainder(span->to - to, period), 0.0);
    }
  }
}

/// A piece from a corner to itself: its two ends are told apart by the neighbour.
TEST(CurvePieces, ALoopAtACorner)
{
  const CurvePieces pieces = joined({ piece(0, 1, 1, 2.0, 12.0) });
  expectSpan(pieces.span(1, AtCorner, 10, onPiece(0, 3.0)), 0, 2.0, 3.0);
  expectSpan(pieces.span(1, AtCorner, 10, onPiece(0, 11.0)), 0, 12.0, 11.0);
  EXPECT_FALSE(pieces.span(1, AtCorner, 1, AtCorner));
}

/// Neighbours well under half of a closed piece apart; on others any.
TEST(CurvePieces, NeighboursOnClosedPiecesAreNotFarApart)
{
  const CurvePieces pieces = joined(
    { piece(0, 1, 2, 0.0, 10.0), closedPiece(0, 10.0), piece(0, 3, 3, 10.0, 0.0) });
  for (Index k : { 0, 1, 2 })
  {
    for (double to : { 1.0, 4.9, 5.1, 9.0 })
    {
      // What is half of it or more could as well be meant the other way round.
      EXPECT_TRUE(k == 0 || to < 5.0 || !pieces.mayBeNeighbours({ k, 0.0, to })) << to;
      EXPECT_EQ(pieces.mayBeNeighbours({ k, to, 0.0 }), pieces.mayBeNeighbours({ k, 0.0, to }));
      EXPECT_TRUE((k > 0 && to > 1.0) || pieces.mayBeNeighbours({ k, 0.0, to })) << to;
    }
  }
}

/// Of several pieces between two corners it is the edge of the input, in whatever order they come.
TEST(CurvePieces, BetweenTheSameTwoCorners)
{
  std::vector<CurvePiece> all{ piece(0, 1, 2), piece(1, 2, 1), piece(2, 1, 2) };
  EXPECT_FALSE(joined(all).span(1, AtCorner, 2, AtCorner));
  for (std::size_t edge = 0; edge < all.size(); ++edge)
  {
    std::vector<CurvePiece> some = all;
    some[edge].isEdge = true;
    const bool forward = some[edge].ends[0] == 1;
    expectSpan(joined(some).span(1, AtCorner, 2, AtCorner), static_cast<Index>(edge),
      forward ? 0.0 : 1.0, forward ? 1.0 : 0.0);
  }
  // Nodes between are on their own piece in any case.
  expectSpan(joined(all).span(1, AtCorner, 10, onPiece(1, 0.5)), 1, 1.0, 0.5);
  // On no curve: neighbours, but there is no span.
  all = { piece(None, 1, 2) };
  EXPECT_FALSE(joined(all).span(1, AtCorner, 2, AtCorner));
}

TEST(CurvePieces, BeginAnew)
{
  CurvePieces pieces = joined({ piece(0, 1, 2), piece(0, 2, 3) });
  EXPECT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[1].ends[1], 3);
  pieces.clear();
  pieces.join();
  EXPECT_EQ(pieces.size(), 0u);
  EXPECT_FALSE(pieces.span(1, AtCorner, 2, AtCorner));
}

// ---- corners that become one --------------------------------------------------------------------

/// 1 - 2 = 3 - 4: the short piece in the middle may vanish. Then the one that is left is an end of
/// the pieces of both.
TEST(CurvePieces, TheOneThatIsLeftStandsForBoth)
{
  std::vector<CurvePiece> all{ piece(0, 1, 2, 0.0, 3.0), piece(0, 2, 3, 3.0, 4.0),
    piece(0, 3, 4, 4.0, 8.0) };
  EXPECT_FALSE(joined(all).mayBecomeOne(2, 3)); // it must stay
  all[1].mayVanish = true;
  const CurvePieces pieces = joined(all);
  EXPECT_TRUE(pieces.mayBecomeOne(2, 3));
  EXPECT_TRUE(pieces.mayBecomeOne(3, 2));
  EXPECT_FALSE(pieces.mayBecomeOne(2, 2));
  EXPECT_FALSE(pieces.mayBecomeOne(1, 2));
  EXPECT_EQ(pieces.tipAt(2), None);
  for (Index left : { 2, 3 })
  {
    expectSpan(pieces.span(1, AtCorner, left, AtCorner), 0, 0.0, 3.0);
    expectSpan(pieces.span(left, AtCorner, 4, AtCorner), 2, 4.0, 8.0);
    expectSpan(pieces.span(10, onPiece(0, 1.0), left, AtCorner), 0, 1.0, 3.0);
    expectSpan(pieces.span(10, onPiece(2, 7.0), left, AtCorner), 2, 7.0, 4.0);
  }
  EXPECT_FALSE(pieces.span(1, AtCorner, 4, AtCorner));
}

/// The tip of a short piece goes to the corner from which it starts, not the other way.
TEST(CurvePieces, ATipGoesToItsCorner)
{
  std::vector<CurvePiece> all{ piece(0, 1, 2), piece(1, 2, 3), piece(2, 2, 4) };
  all[2].mayVanish = true;
  const CurvePieces pieces = joined(all);
  EXPECT_TRUE(pieces.mayBecomeOne(4, 2));
  EXPECT_FALSE(pieces.mayBecomeOne(2, 4)); // it has other pieces, and 4 has none
  EXPECT_EQ(pieces.tipAt(2), 4);
  EXPECT_EQ(pieces.tipAt(4), None);
  // A piece by itself stays: of it nothing would be left.
  std::vector<CurvePiece> one{ piece(0, 1, 2) };
  one[0].mayVanish = true;
  EXPECT_FALSE(joined(one).mayBecomeOne(1, 2));
  EXPECT_FALSE(joined(one).mayBecomeOne(2, 1));
}

namespace
{
/// A network of few corners and many pieces, in which anything can happen.
std::vector<CurvePiece> randomNetwork(TestRandom& random)
{
  const auto upTo = [&](int n)
  { return static_cast<Index>(std::min(n - 1.0, n * 0.5 * (1.0 + random()))); };
  const int corners = 3 + upTo(6), count = 2 + upTo(9);
  std::vector<CurvePiece> all;
  for (int k = 0; k < count; ++k)
  {
    CurvePiece p = piece(k, upTo(corners), upTo(corners));
    p.mayVanish = p.ends[0] != p.ends[1] && random() > 0.0;
    all.push_back(p);
  }
  return all;
}

/// Whether the two may become one, whichever of them is left.
bool areOne(const CurvePieces& pieces, Index a, Index b)
{
  return pieces.mayBecomeOne(a, b) || pieces.mayBecomeOne(b, a);
}

/// To which corners, with those that become one counted as one, the pieces of a lead, but for
/// piece k.
std::multiset<Index> leadsTo(
  const std::vector<CurvePiece>& all, const std::vector<Index>& name, Index a, std::size_t k)
{
  std::multiset<Index> there;
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    for (int i = 0; i < 2 && n != k; ++i)
    {
      if (all[n].ends[i] == a)
      {
        there.insert(name[all[n].ends[1 - i]]);
      }
    }
  }
  return there;
}
}

/// What the header says of corners that become one, in random networks; and no more pieces could
/// vanish without breaking it.
TEST(CurvePieces, ItStaysClearWhichPieceAnEdgeIsOn)
{
  TestRandom random(1);
  int ones = 0, refused = 0, tips = 0;
  for (int trial = 0; trial < 2000; ++trial)
  {
    SCOPED_TRACE("network " + std::to_string(trial));
    const std::vector<CurvePiece> all = randomNetwork(random);
    const CurvePieces pieces = joined(all);
    std::vector<Index> name(10), partner(10, None);
    for (Index a = 0; a < 10; ++a)
    {
      name[a] = a;
      for (Index b = 0; b < 10; ++b)
      {
        if (areOne(pieces, a, b))
        {
          EXPECT_EQ(partner[a], None) << "one partner at most";
          partner[a] = b;
          name[a] = std::min(a, b);
        }
      }
    }
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      const auto [a, b] = all[k].ends;
      if (!all[k].mayVanish)
      {
        continue;
      }
      const std::multiset<Index> fromA = leadsTo(all, name, a, k), fromB = leadsTo(all, name, b, k);
      // Another piece between both, or one to the same third corner.
      bool isClear = fromA.count(name[a]) + fromA.count(name[b]) + fromB.count(name[a]) +
          fromB.count(name[b]) ==
        0;
      for (Index there : fromA)
      {
        isClear = isClear && fromB.count(there) == 0;
      }
      if (partner[a] == b)
      {
        ++ones;
        EXPECT_TRUE(isClear);
        EXPECT_FALSE(fromA.empty() && fromB.empty());
        // Who has no other piece is the tip, and nobody's target.
        EXPECT_EQ(pieces.mayBecomeOne(a, b), !fromB.empty());
        EXPECT_EQ(pieces.mayBecomeOne(b, a), !fromA.empty());
        EXPECT_EQ(pieces.tipAt(a), fromB.empty() ? b : None);
        tips += fromB.empty() || fromA.empty();
      }
      else
      {
        ++refused;
        EXPECT_TRUE(
          partner[a] != None || partner[b] != None || !isClear || (fromA.empty() && fromB.empty()));
      }
    }
  }
  EXPECT_GT(ones, 200);
  EXPECT_GT(refused, 200);
  EXPECT_GT(tips, 20);
}

/// Between two corners, each perhaps the one left of two: the only piece between these, or none.
TEST(CurvePieces, SpansOfCornersAgainstASearchOfAllPieces)
{
  TestRandom random(2);
  int found = 0, several = 0;
  for (int trial = 0; trial < 2000; ++trial)
  {
    SCOPED_TRACE("network " + std::to_string(trial));
    const std::vector<CurvePiece> all = randomNetwork(random);
    const CurvePieces pieces = joined(all);
    const auto same = [&](Index a, Index b) { return a == b || areOne(pieces, a, b); };
    for (Index a = 0; a < 9; ++a)
    {
      for (Index b = 0; b < 9; ++b)
      {
        if (same(a, b))
        {
          continue; // nothing is left between them
        }
        std::vector<Index> between;
        for (std::size_t k = 0; k < all.size(); ++k)
        {
          const auto [p, q] = all[k].ends;
          if ((same(a, p) && same(b, q)) || (same(a, q) && same(b, p)))
          {
            between.push_back(static_cast<Index>(k));
          }
        }
        const auto span = pieces.span(a, AtCorner, b, AtCorner);
        EXPECT_EQ(span.has_value(), between.size() == 1) << a << ", " << b;
        if (span && between.size() == 1)
        {
          EXPECT_EQ(span->part, between[0]);
          const CurvePiece& p = all[between[0]];
          EXPECT_EQ(span->from, p.range[same(a, p.ends[0]) ? 0 : 1]);
          EXPECT_EQ(span->to, p.range[same(b, p.ends[1]) ? 1 : 0]);
        }
        found += span.has_value();
        several += between.size() > 1;
      }
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(several, 1000);
}
