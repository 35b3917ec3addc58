/* SPDX-License-Identifier: BSD-3-Clause */
/** @file
 *  Includes all public headers except catalog.h, which belongs to a separate library. The
 *  comments in each header are the manual of its topic. */
#ifndef BAUM_BAUM_H
#define BAUM_BAUM_H

#include <baum/breaks.h>
#include <baum/draw.h>
#include <baum/dynamics.h>
#include <baum/elements.h>
#include <baum/events.h>
#include <baum/mechanism.h>
#include <baum/planar.h>
#include <baum/planar_joints.h>
#include <baum/report.h>
#include <baum/scene.h>
#include <baum/simulation.h>
#include <baum/spatial.h>
#include <baum/spatial_joints.h>
#include <baum/spatial_points.h>
#include <baum/spline.h>
#include <baum/stabilization.h>
#include <baum/status.h>
#include <baum/study.h>
#include <baum/sweep.h>
#include <baum/version.h>

#endif
