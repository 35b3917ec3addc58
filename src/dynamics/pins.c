/* SPDX-License-Identifier: BSD-3-Clause */
/* The geometry of all revolute joints, with the equations of mechanism/joints/pin_rows.c:
 *
 *   Phi   = r_a + p_a - r_b - p_b,   Phi' likewise,   gamma = p_a w_a^2 - p_b w_b^2
 *   r     = gamma - 2 alpha Phi' - beta^2 Phi
 *   c_a   = k x p_a,   c_b = -k x p_b
 *   D     = (w_a0 + w_b0) I + w_a2 c_a c_a^T + w_b2 c_b c_b^T
 *   J a0 - r
 *
 * No J is formed. This is no hot file: products that a processor fuses would make another J than the
 * one that is reported, by a last digit, which close to a singular pose counts.
 */
#include "dynamics/pins.h"

void baum_i_pins_set(baum_i_block *block, const baum_i_pins *pins)
{
  double damping = pins->damping;
  double stiffness = pins->stiffness;
  for (int i = 0; i < block->pin_count; i++) {
    const baum_i_pin_node *pin = &block->pins[i];
    const double *s = pins->points + 4 * (size_t)i;
    /* Triples of planar bodies have the numbers of the bodies. */
    const baum_i_frame *a = &pins->frames[pin->triple[0]];
    const baum_i_frame *b = &pins->frames[pin->triple[1]];
    double ax = a->c * s[0] - a->s * s[1];
    double ay = a->s * s[0] + a->c * s[1];
    double bx = b->c * s[2] - b->s * s[3];
    double by = b->s * s[2] + b->c * s[3];
    double wa = a->w * a->w;
    double wb = b->w * b->w;
    double phi0 = (a->x + ax) - (b->x + bx);
    double phi1 = (a->y + ay) - (b->y + by);
    double rate0 = (a->vx - a->w * ay) - (b->vx - b->w * by);
    double rate1 = (a->vy + a->w * ax) - (b->vy + b->w * bx);
    double gamma0 = ax * wa - bx * wb;
    double gamma1 = ay * wa - by * wb;
    double right0 = gamma0 - damping * rate0 - stiffness * phi0;
    double right1 = gamma1 - damping * rate1 - stiffness * phi1;

    const double *free_a = block->free + 4 * (size_t)pin->triple[0];
    const double *free_b = block->free + 4 * (size_t)pin->triple[1];
    const double *weight_a = block->weight + 4 * (size_t)pin->triple[0];
    const double *weight_b = block->weight + 4 * (size_t)pin->triple[1];
    double d0 = weight_a[0] + weight_b[0] + weight_a[2] * ay * ay + weight_b[2] * by * by;
    double d1 = -(weight_a[2] * ax * ay + weight_b[2] * bx * by);
    double d2 = weight_a[0] + weight_b[0] + weight_a[2] * ax * ax + weight_b[2] * bx * bx;

    double *arm = block->arm + 4 * (size_t)i;
    arm[0] = -ay;
    arm[1] = ax;
    arm[2] = by;
    arm[3] = -bx;
    size_t node = (size_t)pin->node;
    block->right[2 * node] = right0;
    block->right[2 * node + 1] = right1;
    block->lambda[2 * node] = free_a[0] - free_b[0] - ay * free_a[2] + by * free_b[2] - right0;
    block->lambda[2 * node + 1] = free_a[1] - free_b[1] + ax * free_a[2] - bx * free_b[2] - right1;
    block->pivot[3 * node] = d0;
    block->pivot[3 * node + 1] = d1;
    block->pivot[3 * node + 2] = d2;
    block->size[node] = d0 * d2;
    pins->phi[pin->row] = phi0;
    pins->phi[pin->row + 1] = phi1;
    pins->phi_rate[pin->row] = rate0;
    pins->phi_rate[pin->row + 1] = rate1;
    pins->gamma[pin->row] = gamma0;
    pins->gamma[pin->row + 1] = gamma1;
  }
}
