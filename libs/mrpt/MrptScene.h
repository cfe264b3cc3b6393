#pragma once
// MRPT's 3D scenes are in mrpt::opengl until version 2, in mrpt::viz since version 3.
#include <mrpt/img/TColor.h>
#include <mrpt/version.h>

#if MRPT_VERSION < 0x030000
#include <mrpt/opengl/CDisk.h>
#include <mrpt/opengl/COctoMapVoxels.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/opengl/CSphere.h>
#include <mrpt/opengl/CVectorField3D.h>
#include <mrpt/opengl/stock_objects.h>
#else
#include <mrpt/viz/CDisk.h>
#include <mrpt/viz/COctoMapVoxels.h>
#include <mrpt/viz/CPointCloud.h>
#include <mrpt/viz/CPointCloudColoured.h>
#include <mrpt/viz/CSetOfLines.h>
#include <mrpt/viz/CSetOfObjects.h>
#include <mrpt/viz/CSetOfTriangles.h>
#include <mrpt/viz/CSphere.h>
#include <mrpt/viz/CVectorField3D.h>
#include <mrpt/viz/Scene.h>
#include <mrpt/viz/stock_objects.h>
#endif

namespace hagen::observations {

#if MRPT_VERSION < 0x030000
namespace viz = mrpt::opengl;
using Scene = mrpt::opengl::COpenGLScene;
using VisualObject = mrpt::opengl::CRenderizable;
#else
namespace viz = mrpt::viz;
using Scene = mrpt::viz::Scene;
using VisualObject = mrpt::viz::CVisualObject;
#endif

/// Colour maps return a TColor until version 2, a TColorf since version 3.
inline mrpt::img::TColor colorOf(const mrpt::img::TColor& color) { return color; }
inline mrpt::img::TColor colorOf(const mrpt::img::TColorf& color) { return color.asTColor(); }

}  // namespace hagen::observations
