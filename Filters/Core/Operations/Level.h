// SPDX-License-Identifier: BSD-3-Clause
/// @file Level.h
/// How much effort the fast engine spends on one bad cell.
#ifndef meshopt_Operations_Level_h
#define meshopt_Operations_Level_h

namespace meshopt
{
/// Each level includes those before it.
struct Level
{
  enum : int
  {
    Topology = 0,  ///< edge and face removal, node motion
    Insertion = 1, ///< also removal and insertion of nodes
    LookAhead = 2, ///< also several changes that gain only together
    /// More look-ahead, cluster motion, retriangulation.
    LongLookAhead = 3
  };
  static constexpr int Count = 4;
};
}

#endif
