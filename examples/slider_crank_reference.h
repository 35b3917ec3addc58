/* SPDX-License-Identifier: BSD-3-Clause */
/* The undriven slider-crank of slider_crank_model.h, exactly: t, angle of the crank, angle of the rod, x of the
 * slider. Made without this library, from Lagrangian index-1 equations in two angles, by
 * Gragg-Bulirsch-Stoer extrapolation in 160-bit arithmetic; two runs of different order and tolerance agree to 17
 * digits, and a second model in the coordinates of the bodies, written apart from the first and integrated in
 * double precision, to 12.8. */
#ifndef SLIDER_CRANK_REFERENCE_H
#define SLIDER_CRANK_REFERENCE_H

#include "slider_crank_model.h"

enum { REFERENCE_SAMPLES = 21 };

static const struct {
  double t;     /* [s] */
  double crank; /* [rad] */
  double rod;   /* [rad] */
  double x;     /* [m] */
} REFERENCE[REFERENCE_SAMPLES] = {
  {0.00, 0.0, 0.1641346706128604, 0.4548873962258113},
  {0.01, 1.0500394343682515, -0.2737282260080309, 0.3707306849645355},
  {0.02, 1.782695806337261, -0.3314536498181835, 0.25716596883989007},
  {0.03, 2.8002250523893384, -0.003989363913989536, 0.1618260158808433},
  {0.04, 4.227465805844174, 0.6507132699518482, 0.1721500119947814},
  {0.05, 5.025694432225405, 0.6932738354489913, 0.28251768120302073},
  {0.06, 5.6880420685222965, 0.4597369428862726, 0.4009222257549144},
  {0.07, 6.854456389677515, -0.10715713320160522, 0.43295063472049816},
  {0.08, 7.640772286693244, -0.33130753721616923, 0.32173350025683956},
  {0.09, 8.437254953501489, -0.2567448637823558, 0.2117037089884857},
  {0.10, 9.713897546217297, 0.3109391901511484, 0.14467649753287223},
  {0.11, 10.908355880428662, 0.7228146608913634, 0.216156219535605},
  {0.12, 11.5801338170528, 0.6191907130033526, 0.33362092655964987},
  {0.13, 12.371942889735331, 0.2630234764374425, 0.4455933699830063},
  {0.14, 13.508226716521557, -0.2433208885803633, 0.3869943095381482},
  {0.15, 14.237184762840975, -0.3406528518433265, 0.2731390187332284},
  {0.16, 15.183026033905461, -0.08729146762134653, 0.17243553459351146},
  {0.17, 16.623467640735036, 0.5941851078037876, 0.1603163383925635},
  {0.18, 17.498326392851066, 0.7094210924861045, 0.26549861153566356},
  {0.19, 18.148227853497986, 0.5075243388792688, 0.38431867043005075},
  {0.20, 19.26142594130165, -0.03677142534394082, 0.44599833952861234},
};

/* Largest difference from sample k, angles in radians, x by the length scale. The run stands there. */
static inline double slider_crank_error(const slider_crank *s, baum_simulation *run, int k)
{
  const baum_channel channels[] = {{.quantity = BAUM_BODY_POSE, .body = s->crank},
                                   {.quantity = BAUM_BODY_POSE, .body = s->rod},
                                   {.quantity = BAUM_BODY_POSE, .body = s->slider}};
  double pose[9];
  double scale;
  CHECK(baum_mechanism_get_scale(s->mechanism, &scale));
  CHECK(baum_simulation_get(run, channels, 3, pose));
  double angle = fmax(fabs(pose[2] - REFERENCE[k].crank), fabs(pose[5] - REFERENCE[k].rod));
  return fmax(angle, fabs(pose[6] - REFERENCE[k].x) / scale);
}

#endif
