// SPDX-License-Identifier: BSD-3-Clause
/**
 * Gives `MeshQuality` and `MinimumDihedralAngle` colour maps of their own: loud where elements are
 * bad, pale where they are good, over a range that does not move with the data; and a title.
 *
 * They are settings of ParaView, by the name of the array, and so hold in the window, pvpython and
 * pvbatch. What the user has saved as default for the array, and what a state file or script sets,
 * counts more. Not covered: representations with "separate color map".
 */
#ifndef MeshOptimizeColorMaps_h
#define MeshOptimizeColorMaps_h

/**
 * Called once when the plugin is loaded.
 */
void MeshOptimizeAddColorMaps();

#endif
