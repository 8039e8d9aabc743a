// SPDX-License-Identifier: BSD-3-Clause
/// @file LongEdges.h
/// Division of the longest edges at bad cells, where the surface takes part.
///
/// A surface of needles, facets much longer than wide, holds its cells down, and so does a thin
/// part. Only shorter edges help there. But the first division of a row of needles makes worse
/// cells of their neighbours, so that no change that has to raise the worst one begins it. Here
/// many edges are divided at once; the engine works on what comes of it, and the caller compares.
///
/// Reference: M.-C. Rivara, New longest-edge algorithms for the refinement and/or improvement of
/// unstructured triangulations, Int. J. Numer. Meth. Engng. 40 (1997): an edge is divided only
/// where it is the longest one of all cells around it, so that no cell becomes much worse.
#ifndef meshopt_WorstFirst_LongEdges_h
#define meshopt_WorstFirst_LongEdges_h

#include "Run/Run.h"

namespace meshopt
{
/// Divides the longest edges of cells whose quality is under `below`. Parts whose shape
/// (MeanEdgeShape) is below `partsBelow` times the worst shape at first are divided again. The
/// worst cells come first, until no such cell is left, the run's growth is used up, or the clock
/// stops. What is kept stays; an edge of the surface is divided where the surface allows it. No
/// cell is inverted by that, but qualities may fall. Adds a row to the history. Returns the number
/// of divisions. Precondition: no cell is inverted. The cost: a few looks at all cells, beside the
/// divisions.
long divideLongEdges(Run<3>& run, double below, double partsBelow);
}

#endif
