#pragma once
#include <mrpt/opengl/CSetOfObjects.h>
