// SPDX-License-Identifier: BSD-3-Clause
/// @file Level.h
/// How far the fast engine goes for one bad cell.
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
    LookAhead = 2, ///< also several changes that pay only together
    LongLookAhead = 3
  };
  static constexpr int Count = 4;
};
}

#endif
