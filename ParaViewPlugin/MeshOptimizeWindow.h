// SPDX-License-Identifier: BSD-3-Clause
/**
 * Adds the toolbar "Mesh Optimize" to ParaView's window, when the plugin is loaded. Where there is
 * no window (pvserver, pvpython, pvbatch), or the toolbar was not built, nothing happens.
 */
#ifndef MeshOptimizeWindow_h
#define MeshOptimizeWindow_h

void MeshOptimizeAddToolBar();

#endif
