#pragma once
#include <mrpt/opengl/CVectorField3D.h>
