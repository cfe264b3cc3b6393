#pragma once
#include <mrpt/opengl/COctoMapVoxels.h>
