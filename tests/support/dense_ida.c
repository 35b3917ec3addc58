/* SPDX-License-Identifier: BSD-3-Clause */
#include "dense_ida.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#if BAUM_HAVE_SUNDIALS

#include <ida/ida.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "integrate/sundials_driver.h"

static struct {
  SUNMatrix matrix;
  SUNLinearSolver solver;
  baum_i_sundials_method method;
  baum_integrator ida;
} dense;

/* Clones a vector without allocating memory for its numbers. */
static N_Vector clone_empty(N_Vector like)
{
  N_Vector vector = N_VCloneEmpty_Serial(like);
  vector->ops->nvdestroy = N_VDestroy_Serial;
  return vector;
}

static int attach(baum_i_sundials *run)
{
  sunindextype n = N_VGetLength(run->y);
  for (int k = 0; k < BAUM_I_SUNDIALS_VECTORS; k++) {
    run->vectors[k]->ops->nvcloneempty = clone_empty;
  }
  dense.matrix = SUNDenseMatrix(n, n, run->context);
  dense.solver = SUNLinSol_Dense(run->y, dense.matrix, run->context);
  int flag = ((const baum_i_sundials_method *)baum_ida()->table)->attach(run);
  return flag == 0 ? IDASetLinearSolver(run->memory, dense.solver, dense.matrix) : flag;
}

void dense_ida_use(integrator_run *run)
{
  baum_i_integrator_destroy(run->integrator, run->self);
  dense.method = *(const baum_i_sundials_method *)baum_ida()->table;
  dense.method.attach = attach;
  dense.ida = *baum_ida();
  dense.ida.table = &dense.method;
  run->integrator = &dense.ida;
  assert_int_equal(baum_i_integrator_create(&dense.ida, &run->problem, &run->state, &run->self),
                   BAUM_OK);
}

void dense_ida_release(void)
{
  (void)SUNLinSolFree(dense.solver);
  SUNMatDestroy(dense.matrix);
}

#endif
