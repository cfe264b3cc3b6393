#pragma once
#include <mrpt/opengl/stock_objects.h>
