#pragma once
#include <mrpt/opengl/CPointCloud.h>
