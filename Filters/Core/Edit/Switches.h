// SPDX-License-Identifier: BSD-3-Clause
/// @file Switches.h
/// Which kinds of change a run may make.
#ifndef meshopt_Edit_Switches_h
#define meshopt_Edit_Switches_h

namespace meshopt
{
struct Switches
{
  bool moveNodes = true;   ///< node repositioning (section 2.2)
  bool reconnect = true;   ///< changes of topology that keep the points
  bool insertNodes = true; ///< changes of topology that add points
  bool removeNodes = true; ///< changes of topology that take points away

  /// When nothing else gains: changes that pay only together, or after nodes have moved. The paper
  /// has no such thing; without it Algorithm::Paper1996 is what the paper says.
  bool lookAhead = true;
};
}

#endif
