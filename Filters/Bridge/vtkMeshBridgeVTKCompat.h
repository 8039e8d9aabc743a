// SPDX-License-Identifier: BSD-3-Clause
/**
 * The one place that knows VTK versions (9.1 and later): every VTK_VERSION_CHECK of the project
 * stands here.
 */
#ifndef vtkMeshBridgeVTKCompat_h
#define vtkMeshBridgeVTKCompat_h

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

namespace vtkMeshBridge
{

/**
 * Did the user ask `self` to stop? CheckAbort() walks up the pipeline; VTK 9.1 has the flag only.
 * ParaView 5.11's VTK reports 9.2.20230111 and has CheckAbort().
 */
inline bool CheckAbort(vtkAlgorithm* self)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
  return self->CheckAbort();
#else
  return self->GetAbortExecute() != 0;
#endif
}

/**
 * VTK empties the output of a filter that has seen an abort. Says that the output of `self` is fit
 * for use all the same.
 */
inline void KeepOutputAfterAbort(vtkAlgorithm* self)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
  if (self->GetAbortOutput())
  {
    self->SetAbortOutput(false);
  }
#else
  (void)self;
#endif
}

} // namespace vtkMeshBridge

#endif
