#pragma once
#include <mrpt/opengl/CSphere.h>
