// SPDX-License-Identifier: BSD-3-Clause
/// @file Level.h
/// How much effort the fast engine spends on one bad cell.
#ifndef meshopt_Operations_Level_h
#define meshopt_Operations_Level_h

namespace meshopt
{
/// Each level includes those before it. Where the surface takes part, the same kinds of change are
/// also made on it (BoundaryChange.h).
struct Level
{
  enum : int
  {
    Topology = 0,  ///< edge and face removal, node motion
    Removal = 1,   ///< also removal of nodes
    Insertion = 2, ///< also insertion of nodes
    LookAhead = 3, ///< also several changes that gain only together, and motion off the surface
    /// More look-ahead, cluster motion, retriangulation, wide insertion.
    LongLookAhead = 4
  };
  static constexpr int Count = 5;
};
}

#endif
