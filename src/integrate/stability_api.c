/* SPDX-License-Identifier: BSD-3-Clause */
/* Public functions about stability: they check arguments and call src/stabilization with the method
 * of the integrator. */
#include "integrate/integrator.h"

#include "base/message.h"
#include "base/sized.h"
#include "mechanism/fields.h"

/* ---- checks ---- */

static baum_status check_integrator(const baum_integrator *integrator)
{
  return integrator
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_ARGUMENT,
                         "stability: integrator is NULL, must be one such as baum_euler()");
}

/* Check that the integrator has a fixed step and uses gains, because only such methods have a
 * region of stability. */
static baum_status check_fixed_step(const baum_integrator *integrator)
{
  BAUM_I_TRY(check_integrator(integrator));
  const char *why = NULL;
  if (integrator->without_freedom) {
    why = "solves positions from the constraints, so there is nothing to stabilize and no region";
  } else if (integrator->method.kind == BAUM_I_METHOD_VARIABLE_STEP) {
    why = "chooses its step, so it has no fixed region of stability";
  } else if (integrator->method.kind == BAUM_I_METHOD_WITHOUT_GAINS) {
    why = "keeps the constraints by itself, without gains, so it has no region of stability";
  }
  return why ? baum_i_fail(BAUM_ERR_UNSUPPORTED, "%s %s", integrator->name, why) : BAUM_OK;
}

static const char *const LABEL = "stability";

static baum_status check_point(double alpha_h, double beta2_h2)
{
  BAUM_I_TRY(baum_i_check_finite(LABEL, "alpha_h", "", alpha_h));
  return baum_i_check_finite(LABEL, "beta2_h2", "", beta2_h2);
}

static baum_status check_out(const void *out, const char *name)
{
  return baum_i_check_given(LABEL, name, out != NULL);
}

static baum_status check_pair(const void *first, const char *first_name, const void *second,
                              const char *second_name)
{
  BAUM_I_TRY(check_out(first, first_name));
  return check_out(second, second_name);
}

/* Check the capacity of two arrays, the arrays, and the pointer for the number of their entries. */
static baum_status check_arrays(int32_t capacity, const void *first, const char *first_name,
                                const void *second, const char *second_name, const int32_t *count)
{
  if (capacity < 0) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "capacity is %d, must be >= 0", (int)capacity);
  }
  BAUM_I_TRY(check_out(count, "count"));
  return capacity > 0 ? check_pair(first, first_name, second, second_name) : BAUM_OK;
}

static baum_status check_range(const double range[2], const char *name)
{
  BAUM_I_TRY(check_out(range, name));
  BAUM_I_TRY(baum_i_check_finite(LABEL, name, "", range[0]));
  return baum_i_check_finite(LABEL, name, "", range[1]);
}

/* ---- at a point ---- */

baum_status baum_stability_at(const baum_integrator *integrator, double alpha_h, double beta2_h2,
                              baum_amplification *out, size_t caller_size)
{
  BAUM_I_TRY(check_integrator(integrator));
  BAUM_I_TRY(check_point(alpha_h, beta2_h2));
  BAUM_I_TRY(baum_i_check_sized(out, caller_size, "baum_stability_at"));
  baum_amplification amplification = {.struct_size = 0};
  baum_i_amplification(&integrator->method, alpha_h, beta2_h2, &amplification);
  baum_i_give_sized(out, caller_size, &amplification, sizeof amplification);
  return BAUM_OK;
}

baum_status baum_stability_velocity_at(const baum_integrator *integrator, double alpha_h,
                                       baum_amplification *out, size_t caller_size)
{
  BAUM_I_TRY(check_integrator(integrator));
  BAUM_I_TRY(baum_i_check_finite(LABEL, "alpha_h", "", alpha_h));
  BAUM_I_TRY(baum_i_check_sized(out, caller_size, "baum_stability_velocity_at"));
  baum_amplification amplification = {.struct_size = 0};
  baum_i_velocity_amplification(&integrator->method, alpha_h, &amplification);
  baum_i_give_sized(out, caller_size, &amplification, sizeof amplification);
  return BAUM_OK;
}

baum_status baum_stability_velocity_limit(const baum_integrator *integrator, double *alpha_h)
{
  BAUM_I_TRY(check_fixed_step(integrator));
  BAUM_I_TRY(check_out(alpha_h, "alpha_h"));
  *alpha_h = baum_i_velocity_limit(&integrator->method);
  return BAUM_OK;
}

const char *baum_stability_statement(const baum_integrator *integrator)
{
  if (!integrator) {
    return NULL;
  }
  if (integrator->without_freedom) {
    return "Positions are solved from the constraints; there is nothing to stabilize.";
  }
  return baum_i_method_statement(&integrator->method, integrator->family,
                                 integrator->advance != NULL);
}

/* ---- along a ray ---- */

static baum_status check_ray(const baum_integrator *integrator, double damping_ratio)
{
  BAUM_I_TRY(check_fixed_step(integrator));
  return baum_i_check_positive(LABEL, "damping_ratio", "", damping_ratio);
}

typedef double alpha_h_of_ray(const baum_i_method *method, double damping_ratio);

static baum_status answer_ray(const baum_integrator *integrator, double damping_ratio,
                              alpha_h_of_ray *find, double *alpha_h)
{
  BAUM_I_TRY(check_ray(integrator, damping_ratio));
  BAUM_I_TRY(check_out(alpha_h, "alpha_h"));
  *alpha_h = find(&integrator->method, damping_ratio);
  return BAUM_OK;
}

baum_status baum_stability_limit(const baum_integrator *integrator, double damping_ratio,
                                 double *alpha_h)
{
  return answer_ray(integrator, damping_ratio, baum_i_stability_limit, alpha_h);
}

baum_status baum_stability_best_on_ray(const baum_integrator *integrator, double damping_ratio,
                                       double *alpha_h)
{
  return answer_ray(integrator, damping_ratio, baum_i_stability_best_on_ray, alpha_h);
}

baum_status baum_stability_intervals(const baum_integrator *integrator, double damping_ratio,
                                     int32_t capacity, double *from, double *to, int32_t *count)
{
  BAUM_I_TRY(check_ray(integrator, damping_ratio));
  BAUM_I_TRY(check_arrays(capacity, from, "from", to, "to", count));
  *count = baum_i_stability_intervals(&integrator->method, damping_ratio, capacity, from, to);
  return BAUM_OK;
}

/* ---- in the plane ---- */

static baum_status check_point_out(const baum_integrator *integrator, const double *alpha_h,
                                   const double *beta2_h2)
{
  BAUM_I_TRY(check_fixed_step(integrator));
  return check_pair(alpha_h, "alpha_h", beta2_h2, "beta2_h2");
}

baum_status baum_stability_best(const baum_integrator *integrator, double *alpha_h,
                                double *beta2_h2)
{
  BAUM_I_TRY(check_point_out(integrator, alpha_h, beta2_h2));
  baum_i_stability_best(&integrator->method, alpha_h, beta2_h2);
  return BAUM_OK;
}

baum_status baum_stability_deadbeat(const baum_integrator *integrator, double *alpha_h,
                                    double *beta2_h2)
{
  BAUM_I_TRY(check_point_out(integrator, alpha_h, beta2_h2));
  return baum_i_stability_deadbeat(&integrator->method, alpha_h, beta2_h2)
           ? BAUM_OK
           : baum_i_fail(BAUM_ERR_UNSUPPORTED,
                         "%s uses several past steps, so no gains remove a violation in two steps; "
                         "baum_stability_best() returns the point of fastest decay",
                         integrator->name);
}

baum_status baum_stability_nearest(const baum_integrator *integrator, double alpha_h,
                                   double beta2_h2, double *good_alpha_h, double *good_beta2_h2)
{
  BAUM_I_TRY(check_fixed_step(integrator));
  BAUM_I_TRY(check_point(alpha_h, beta2_h2));
  BAUM_I_TRY(check_pair(good_alpha_h, "good_alpha_h", good_beta2_h2, "good_beta2_h2"));
  baum_i_stability_nearest(&integrator->method, alpha_h, beta2_h2, good_alpha_h, good_beta2_h2);
  return BAUM_OK;
}

static baum_status check_grid(const double alpha_h[2], const double beta2_h2[2], int32_t columns,
                              int32_t rows, const double *radius)
{
  BAUM_I_TRY(check_range(alpha_h, "alpha_h"));
  BAUM_I_TRY(check_range(beta2_h2, "beta2_h2"));
  if (!(columns >= 1 && rows >= 1)) {
    return baum_i_fail(BAUM_ERR_ARGUMENT, "columns is %d and rows is %d, must be >= 1",
                       (int)columns, (int)rows);
  }
  return check_out(radius, "radius");
}

/* Return point k of n equally spaced points in a range, whose ends are the first and the last
 * point. The formula avoids the difference of the ends, because this difference might overflow. */
static double share(const double range[2], int32_t k, int32_t n)
{
  double part = n > 1 ? (double)k / (n - 1) : 0.0;
  return range[0] * (1.0 - part) + range[1] * part;
}

baum_status baum_stability_grid(const baum_integrator *integrator, const double alpha_h[2],
                                const double beta2_h2[2], int32_t columns, int32_t rows,
                                double *radius)
{
  BAUM_I_TRY(check_fixed_step(integrator));
  BAUM_I_TRY(check_grid(alpha_h, beta2_h2, columns, rows, radius));
  for (int32_t j = 0; j < rows; j++) {
    for (int32_t i = 0; i < columns; i++) {
      radius[(size_t)j * (size_t)columns + (size_t)i] =
        1.0 + baum_i_amplification_growth(&integrator->method, share(alpha_h, i, columns),
                                          share(beta2_h2, j, rows));
    }
  }
  return BAUM_OK;
}

baum_status baum_stability_outline(const baum_integrator *integrator, double radius,
                                   int32_t capacity, double *alpha_h, double *beta2_h2,
                                   int32_t *count)
{
  BAUM_I_TRY(check_fixed_step(integrator));
  BAUM_I_TRY(baum_i_check_positive(LABEL, "radius", "", radius));
  BAUM_I_TRY(check_arrays(capacity, alpha_h, "alpha_h", beta2_h2, "beta2_h2", count));
  baum_i_outline out = {.capacity = capacity, .alpha_h = alpha_h, .beta2_h2 = beta2_h2};
  baum_i_stability_outline(&integrator->method, radius - 1.0, &out);
  *count = out.count;
  return BAUM_OK;
}
