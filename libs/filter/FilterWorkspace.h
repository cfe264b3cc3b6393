#pragma once
#include <hagen/filter/Extraction.h>
#include <hagen/filter/GroundSurface.h>
#include <hagen/filter/PersistentMaxima.h>
#include <hagen/scan/PixelDirections.h>
#include <hagen/scan/RangeImage.h>
#include "filter/RoiComponents.h"
#include "filter/ground/FartherReturns.h"
#include "filter/image/DeadBeams.h"
#include "filter/paper/Labelling.h"
#include "filter/paper/SingularSpectrumAnalysis.h"
#include "filter/simd/GroundEvidence.h"
#include "filter/simd/GroundFrame.h"
#include "filter/simd/HeightLabels.h"
#include "filter/simd/ObstacleFeet.h"
#include "filter/simd/SpeckRemoval.h"

namespace hagen {

/// Workspaces of all stages, each described with its stage. A filter owns one and reuses it, so
/// that no scan allocates. They have no state: any stage may get a new one at any time. Threads
/// must not share one.
struct FilterWorkspace {
    Scan turned;                     // of a sensor that is not upright
    PixelDirections directions;      // of an image that has not all columns
    ProjectionWorkspace projection;  // stage 1
    DeadBeamsWorkspace dead_beams;   // stage 2
    MaximaWorkspace maxima;          // stage 3
    SsaWorkspace ssa;                // stage 7
    LabellingWorkspace labelling;    // stage 8
    GroundFrameWorkspace ground_frame;
    GroundEvidenceWorkspace evidence;
    Image<Label> candidates;  // of the ground surface
    GroundSurfaceWorkspace ground_surface;
    ToleranceWorkspace tolerance;
    FeetWorkspace feet;
    SpeckWorkspace specks;
    FartherReturnsWorkspace farther_returns;
    ComponentsWorkspace components;
    ExtractionWorkspace extraction;  // stage 9
};

}  // namespace hagen
