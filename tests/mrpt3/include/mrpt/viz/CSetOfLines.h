#pragma once
#include <mrpt/opengl/CSetOfLines.h>
