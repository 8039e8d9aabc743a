// SPDX-License-Identifier: BSD-3-Clause
/// @file SortUnique.h
/// Makes a list a set.
#ifndef meshopt_Base_SortUnique_h
#define meshopt_Base_SortUnique_h

#include <algorithm>

namespace meshopt
{
/// Sorts a list and removes what it contains more than once.
template <class List>
void sortUnique(List& list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}
}

#endif
