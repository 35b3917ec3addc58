/* SPDX-License-Identifier: BSD-3-Clause */
/* Defines the functions of FMI 3.0 that FMUs of this library do not support. They must exist,
 * because some simulators load all functions of the interface. The functions below read only their
 * first argument. This is possible because the calling conventions of the supported systems permit
 * a caller to pass more arguments than the function declares. */
#include "fmu/fmi3.h"

#define REFUSE(NAME)                           \
  FMI3_EXPORT fmi3Status NAME(fmi3Instance);   \
  fmi3Status NAME(fmi3Instance instance)       \
  {                                            \
    return baum_i_fmu_refuse(instance, #NAME); \
  }

#define REFUSE_TYPE(TYPE) \
  REFUSE(fmi3Get##TYPE)   \
  REFUSE(fmi3Set##TYPE)

#define REFUSE_CLOCK(QUANTITY)        \
  REFUSE(fmi3Get##QUANTITY##Decimal)  \
  REFUSE(fmi3Get##QUANTITY##Fraction) \
  REFUSE(fmi3Set##QUANTITY##Decimal)  \
  REFUSE(fmi3Set##QUANTITY##Fraction)

/* Defines the function that would create an FMU of an unsupported kind. It returns NULL. */
#define REFUSE_KIND(NAME)                               \
  FMI3_EXPORT fmi3Instance fmi3Instantiate##NAME(void); \
  fmi3Instance fmi3Instantiate##NAME(void)              \
  {                                                     \
    return NULL;                                        \
  }

REFUSE_KIND(ModelExchange)
REFUSE_KIND(ScheduledExecution)

REFUSE_TYPE(Float32)
REFUSE_TYPE(Int8)
REFUSE_TYPE(UInt8)
REFUSE_TYPE(Int16)
REFUSE_TYPE(UInt16)
REFUSE_TYPE(Int32)
REFUSE_TYPE(UInt32)
REFUSE_TYPE(Int64)
REFUSE_TYPE(UInt64)
REFUSE_TYPE(Boolean)
REFUSE_TYPE(String)
REFUSE_TYPE(Binary)
REFUSE_TYPE(Clock)
REFUSE_CLOCK(Interval)
REFUSE_CLOCK(Shift)

REFUSE(fmi3EnterEventMode)
REFUSE(fmi3EnterStepMode)
REFUSE(fmi3EnterConfigurationMode)
REFUSE(fmi3ExitConfigurationMode)
REFUSE(fmi3EvaluateDiscreteStates)
REFUSE(fmi3UpdateDiscreteStates)
REFUSE(fmi3ActivateModelPartition)

REFUSE(fmi3GetNumberOfVariableDependencies)
REFUSE(fmi3GetVariableDependencies)
REFUSE(fmi3GetDirectionalDerivative)
REFUSE(fmi3GetAdjointDerivative)
REFUSE(fmi3GetOutputDerivatives)

REFUSE(fmi3EnterContinuousTimeMode)
REFUSE(fmi3CompletedIntegratorStep)
REFUSE(fmi3SetTime)
REFUSE(fmi3SetContinuousStates)
REFUSE(fmi3GetContinuousStates)
REFUSE(fmi3GetContinuousStateDerivatives)
REFUSE(fmi3GetNominalsOfContinuousStates)
REFUSE(fmi3GetNumberOfContinuousStates)
REFUSE(fmi3GetEventIndicators)
REFUSE(fmi3GetNumberOfEventIndicators)
