// SPDX-License-Identifier: BSD-3-Clause
/**
 * TetGen in a process of its own.
 *
 * As a library TetGen 1.5 prints to stdout, keeps its state in statics, frees its memory twice
 * after most errors, and ends the process by assertions. In a forked child none of this does harm,
 * and the user can abort at any time. What it prints becomes progress and error messages.
 */
#ifndef vtkTetGenChild_h
#define vtkTetGenChild_h

#include "vtkTetGenJob.h"

#include <functional>
#include <string>

namespace vtkTetGenBridge
{

struct ChildOutcome
{
  enum StateType
  {
    Done,      ///< the mesh is there
    Failed,    ///< TetGen reported an error, or the child crashed
    Aborted,   ///< the progress callback said so
    NotStarted ///< no pipe or no process available
  };
  StateType State = NotStarted;
  std::string Text;   ///< the output of TetGen (the first megabytes)
  std::string Reason; ///< how a child that Failed ended, or why it did NotStart; else empty
};

/**
 * Receives a fraction in [0, 1] and the name of a phase, some ten times a second. False: stop.
 */
using ChildProgress = std::function<bool(double fraction, const std::string& phase)>;

/**
 * Runs TetGen in a child process and waits for it. May throw std::bad_alloc.
 */
ChildOutcome RunInChild(const Job& job, const ChildProgress& progress, Mesh& mesh);

} // namespace vtkTetGenBridge

#endif
