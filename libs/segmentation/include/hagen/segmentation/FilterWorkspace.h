#pragma once
#include <hagen/range_image/RangeImage.h>
#include <hagen/segmentation/CanopyLayer.h>
#include <hagen/segmentation/Extraction.h>
#include <hagen/segmentation/FartherReturns.h>
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

/// The memory of the filter's stages, each described with its stage. A filter owns one and keeps it
/// from scan to scan, so that no scan allocates; it carries nothing over, and any stage may be
/// given a new one at any time. Two threads must not share one.
struct FilterWorkspace {
    ProjectionWorkspace projection;  // stage 1
    MaximaWorkspace maxima;          // stage 3
    SsaWorkspace ssa;                // stage 7
    LabellingWorkspace labelling;    // stage 8
    GroundFrameWorkspace ground_frame;
    GroundSurfaceWorkspace ground_surface;
    ToleranceWorkspace tolerance;
    CanopyWorkspace canopy;
    FeetWorkspace feet;
    SpeckWorkspace specks;
    FartherReturnsWorkspace farther_returns;
    ComponentsWorkspace components;
    ExtractionWorkspace extraction;  // stage 9
};

}  // namespace hagen
