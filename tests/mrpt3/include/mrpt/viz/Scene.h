#pragma once
#include <mrpt/opengl/COpenGLScene.h>
