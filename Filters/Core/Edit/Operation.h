// SPDX-License-Identifier: BSD-3-Clause
/// @file Operation.h
/// The kinds of operations, by name.
#ifndef meshopt_Edit_Operation_h
#define meshopt_Edit_Operation_h

namespace meshopt
{
/// Kinds of operations, as counted in the history.
enum class Operation
{
  NodeMotion = 0,  ///< one solve that moved one node or a cluster's nodes
  EdgeRemoval,     ///< an edge is replaced by faces (the paper: edge cluster to a ring node)
  FaceRemoval,     ///< faces are replaced by an edge (2-3 flip, multi-face removal)
  EdgeContraction, ///< a node goes (the paper: node cluster to a boundary node)
  NodeInsertion,   ///< a node comes (the paper: edge cluster to the midpoint; cavities)
  NodeReplacement, ///< a node is put at the centre of its cluster (the paper: node cluster to centre)
  Retriangulation, ///< a few cells are taken out together and filled anew in the best way
  LookAhead,       ///< several operations that pay only together
  Count
};
inline constexpr int NumberOfOperations = static_cast<int>(Operation::Count);

/// Their names in the history, in the order of their numbers.
inline constexpr const char* OperationNames[] = { "NodeMotion", "EdgeRemoval", "FaceRemoval",
  "EdgeContraction", "NodeInsertion", "NodeReplacement", "Retriangulation", "LookAhead" };
static_assert(sizeof(OperationNames) / sizeof(OperationNames[0]) == NumberOfOperations,
  "a name for each operation");
}

#endif
