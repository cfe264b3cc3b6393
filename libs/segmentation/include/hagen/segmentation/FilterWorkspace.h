#pragma once
#include <hagen/range_image/PixelDirections.h>
#include <hagen/range_image/RangeImage.h>
#include <hagen/segmentation/DeadBeams.h>
#include <hagen/segmentation/Extraction.h>
#include <hagen/segmentation/FartherReturns.h>
#include <hagen/segmentation/GroundEvidence.h>
#include <hagen/segmentation/GroundFrame.h>
#include <hagen/segmentation/GroundSurface.h>
#include <hagen/segmentation/HeightLabels.h>
#include <hagen/segmentation/Labelling.h>
#include <hagen/segmentation/ObstacleFeet.h>
#include <hagen/segmentation/PersistentMaxima.h>
#include <hagen/segmentation/RoiComponents.h>
#include <hagen/segmentation/SingularSpectrumAnalysis.h>
#include <hagen/segmentation/SpeckRemoval.h>

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
