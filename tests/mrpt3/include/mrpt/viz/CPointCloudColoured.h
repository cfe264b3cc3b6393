#pragma once
#include <mrpt/opengl/CPointCloudColoured.h>
