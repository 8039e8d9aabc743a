// SPDX-License-Identifier: BSD-3-Clause
/// @file Operation.h
/// The kinds of operations and their names.
#ifndef meshopt_Edit_Operation_h
#define meshopt_Edit_Operation_h

namespace meshopt
{
/// Kinds of operations, as counted in the history.
enum class Operation
{
  NodeMotion = 0,  ///< one solve that moved a node, or the nodes of a cluster
  EdgeRemoval,     ///< faces replace an edge (in the paper: edge cluster to a ring node)
  FaceRemoval,     ///< an edge replaces a face (2-3 flip; in the paper: cluster at kept facets)
  EdgeContraction, ///< a node is removed (in the paper: node cluster to a boundary node)
  NodeInsertion,   ///< a node is added (in the paper: edge cluster to the midpoint; cavities)
  NodeReplacement, ///< a node moves to the centre of its cluster (paper: node cluster to centre)
  Retriangulation, ///< a few cells are removed together and the hole is filled in the best way
  LookAhead,       ///< several operations that gain only together
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
