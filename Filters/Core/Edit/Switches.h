// SPDX-License-Identifier: BSD-3-Clause
/// @file Switches.h
/// Which kinds of change a run may make.
#ifndef meshopt_Edit_Switches_h
#define meshopt_Edit_Switches_h

namespace meshopt
{
struct Switches
{
  bool moveNodes = true;   ///< node repositioning (section 2.2 of the paper)
  bool reconnect = true;   ///< changes of topology that keep all points
  bool insertNodes = true; ///< changes of topology that add points
  bool removeNodes = true; ///< changes of topology that remove points

  /// When nothing else gains: changes that gain only together, or after nodes have moved. This is
  /// not in the paper. Without it, Algorithm::Paper1996 does exactly what the paper says.
  bool lookAhead = true;
};
}

#endif
