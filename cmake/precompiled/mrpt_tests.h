// The same for tests of what needs MRPT.
#pragma once
#include "mrpt.h"
//
#include <gmock/gmock.h>
#include <gtest/gtest.h>
