// SPDX-License-Identifier: BSD-3-Clause
/**
 * The computer that a rank shares with others.
 */
#ifndef vtkMeshRanksNode_h
#define vtkMeshRanksNode_h

#include "Ranks/vtkMeshRanksExchange.h"

namespace vtkMeshRanks
{

/**
 * The cores that the ranks on this computer may use together, divided by the number of these ranks;
 * at least 1. Cores to which none of them is bound do not count. Collective.
 */
int GetShareOfCores(const Ranks& ranks);

} // namespace vtkMeshRanks

#endif
