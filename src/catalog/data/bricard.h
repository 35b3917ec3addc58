/* SPDX-License-Identifier: BSD-3-Clause */
/* Bricard mechanism A04 of slender rods.
 * Column: angle of the first rod about y. */
#ifndef BAUM_I_CATALOG_DATA_BRICARD_H
#define BAUM_I_CATALOG_DATA_BRICARD_H

enum { BRICARD_SAMPLES = 11, BRICARD_WIDTH = 1 };

static const double BRICARD_T[11] = {0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5};

static const double BRICARD_Q[11] = {0,
                                     0.25304785498930926,
                                     1.037163113059749,
                                     2.1183633336563403,
                                     2.8955832920258424,
                                     3.141546680095768,
                                     2.8814028965971525,
                                     2.0904287554603136,
                                     1.009363901080806,
                                     0.23907418967813635,
                                     0.0001838982021362281};

static const double BRICARD_V[11] = {0,
                                     1.0357141567635428,
                                     2.0403364084543725,
                                     2.0304486807362006,
                                     1.0206146719341496,
                                     -0.013431460717555556,
                                     -1.0508257310722882,
                                     -2.050019902135476,
                                     -2.0203613344971885,
                                     -1.005528520433927,
                                     0.026864155940639813};

#endif
