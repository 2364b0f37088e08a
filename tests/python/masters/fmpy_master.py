"""FMPy: https://github.com/CATIA-Systems/FMPy"""

from task import Task

import fmpy
from fmpy.fmi2 import FMU2Slave

task = Task()
description = fmpy.read_model_description(task.fmu)
references = {variable.name: variable.valueReference for variable in description.modelVariables}
folder = fmpy.extract(task.fmu, task.folder)
fmu = FMU2Slave(
    guid=description.guid,
    unzipDirectory=folder,
    modelIdentifier=description.coSimulation.modelIdentifier,
    instanceName="fmpy",
)
fmu.instantiate()
for name, value in task.parameters.items():
    fmu.setReal([references[name]], [value])
fmu.setupExperiment(startTime=0.0)
fmu.enterInitializationMode()
fmu.exitInitializationMode()
for k, inputs in enumerate(task.inputs):
    fmu.setReal([references[name] for name in task.names], inputs)
    fmu.doStep(currentCommunicationPoint=k * task.step, communicationStepSize=task.step)
    task.row(fmu.getReal([references[name] for name in task.outputs]))
fmu.terminate()
fmu.freeInstance()
task.done()
