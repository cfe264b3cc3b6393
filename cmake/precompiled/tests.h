// Like plain.h, for tests that do not use MRPT.
#pragma once
#include "plain.h"
//
#include <gmock/gmock.h>
#include <gtest/gtest.h>
