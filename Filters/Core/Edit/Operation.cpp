// SPDX-License-Identifier: BSD-3-Clause
#include "Edit/Operation.h"

namespace meshopt
{
const char* toString(Operation op)
{
  switch (op)
  {
    case Operation::NodeMotion:
      return "node motion";
    case Operation::EdgeRemoval:
      return "edge removal";
    case Operation::FaceRemoval:
      return "face removal";
    case Operation::EdgeContraction:
      return "edge contraction";
    case Operation::NodeInsertion:
      return "node insertion";
    case Operation::NodeReplacement:
      return "node replacement";
    case Operation::Retriangulation:
      return "retriangulation";
    case Operation::LookAhead:
      return "look-ahead";
    case Operation::Count:
      break;
  }
  return "";
}
}
