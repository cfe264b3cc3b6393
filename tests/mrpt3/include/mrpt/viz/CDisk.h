#pragma once
#include <mrpt/opengl/CDisk.h>
