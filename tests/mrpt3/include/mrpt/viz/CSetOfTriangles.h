#pragma once
#include <mrpt/opengl/CSetOfTriangles.h>
