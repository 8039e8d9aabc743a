// SPDX-License-Identifier: BSD-3-Clause
/**
 * The only place that depends on VTK versions (9.1 and later): it contains every VTK_VERSION_CHECK
 * of the project.
 */
#ifndef vtkMeshBridgeVTKCompat_h
#define vtkMeshBridgeVTKCompat_h

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

namespace vtkMeshBridge
{

/**
 * Whether the user asked `self` to stop. CheckAbort() walks up the pipeline; VTK 9.1 has only the
 * flag. ParaView 5.11's VTK reports 9.2.20230111 and has CheckAbort().
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
 * VTK empties the output of a filter that has seen an abort. This tells it that the output of
 * `self` is usable nevertheless.
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
