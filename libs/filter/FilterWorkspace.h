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

/// Workspaces of all stages, documented with the stages. A filter owns and reuses one instance, to
/// avoid allocations. Workspaces have no state and may be replaced at any time, but threads must
/// not share them.
struct FilterWorkspace {
    Scan turned, turned_newest;      // scans in the image frame if the sensor is not upright
    PixelDirections directions;      // of a subset of the columns
    ProjectionWorkspace projection;  // stage 1
    DeadBeamsWorkspace dead_beams;   // stage 2
    MaximaWorkspace maxima;          // stage 3
    SsaWorkspace ssa;                // stage 7
    LabellingWorkspace labelling;    // stage 8
    GroundFrameWorkspace ground_frame;
    GroundEvidenceWorkspace evidence;
    Image<Label> candidates;  // candidates for the ground surface
    GroundSurfaceWorkspace ground_surface;
    ToleranceWorkspace tolerance;
    FeetWorkspace feet;
    SpeckWorkspace specks;
    FartherReturnsWorkspace farther_returns;
    ComponentsWorkspace components;
    ExtractionWorkspace extraction;  // stage 9
};

}  // namespace hagen
