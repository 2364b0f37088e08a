within;
package FrettingJoint "The imported FMU of a fretting contact between two translational flanges"
  extends Modelica.Icons.Package;
  import Modelica.Units.SI;
  import Modelica.Blocks.Interfaces.RealInput;
  import Modelica.Blocks.Interfaces.RealOutput;

  partial block ContactFmu "The part of the FMU that a joint uses"
    parameter Real friction_coefficient = 0.6;
    parameter Real rig_stiffness(unit = "N/m") = 1e30 "Of fixture and frame; 1e30: rigid";
    RealInput normal_force(unit = "N");
    RealInput tangential_displacement(unit = "m") "Of body 1 against body 2";
    RealOutput tangential_force(unit = "N") "That body 1 exerts on body 2";
    RealOutput tangential_stiffness(unit = "N/m") "Of contact and rig in series";
    RealOutput contact_displacement(unit = "m") "Without the stretch of the rig";
  end ContactFmu;

  partial model PartialJoint "The force of the FMU, implicit in the displacement of the flanges"
    parameter Real friction_coefficient = 0.6 "As in the FMU";
    parameter Real rig_stiffness(unit = "N/m") = 1e30 "As in the FMU; 1e30: rigid";
    Modelica.Mechanics.Translational.Interfaces.Flange_a flange_a "Body 1, which moves";
    Modelica.Mechanics.Translational.Interfaces.Flange_b flange_b "Body 2";
    RealOutput tangential_displacement(unit = "m") "To the FMU";
    RealInput tangential_force(unit = "N") "From the FMU";
    RealInput tangential_stiffness(unit = "N/m") "From the FMU";
    RealInput contact_displacement(unit = "m") "From the FMU";
    RealInput normal_force(unit = "N") "The same as to the FMU";
    SI.Position last_displacement "To which the force of the FMU belongs";
    SI.Force friction_limit;
    SI.Force force "That body 1 exerts on body 2";
  equation
    tangential_displacement = flange_a.s - flange_b.s;
    // The outputs of the FMU are constant between two communication points. Continued along the
    // tangent, the force depends on the displacement at the same instant: a stiff contact is
    // stable, and a spring without a mass at the flange has a solution.
    last_displacement = contact_displacement + tangential_force / rig_stiffness;
    friction_limit = friction_coefficient * normal_force;
    force = max(-friction_limit, min(friction_limit,
      tangential_force + tangential_stiffness * (tangential_displacement - last_displacement)));
    flange_b.f = -force;
  end PartialJoint;

  model Joint "Connects the FMU with two flanges"
    extends PartialJoint;
  equation
    flange_a.f = force;
  end Joint;

  model JointWithMass "Connects the FMU with two flanges; body 1 has a mass"
    extends PartialJoint;
    parameter SI.Mass m "Of body 1";
    SI.Position s(start = 0, fixed = true) "Of body 1";
    SI.Velocity v(start = 0, fixed = true) "Of body 1";
  equation
    s = flange_a.s;
    v = der(s);
    m * der(v) = flange_a.f - force;
  end JointWithMass;

  block StandIn "A spring in series with a slider, in place of the imported FMU"
    extends ContactFmu;
    parameter SI.Time communication_step = 1e-5;
    parameter Real contact_stiffness(unit = "N/m") = 35.47e6 "Of the contact in full stick, 2G*a";
    parameter Real stiffness(unit = "N/m") = 1 / (1 / contact_stiffness + 1 / rig_stiffness);
    discrete SI.Force held_force(start = 0, fixed = true);
    discrete SI.Position held_displacement(start = 0, fixed = true);
  equation
    when sample(communication_step, communication_step) then
      held_displacement = pre(tangential_displacement);
      held_force = max(-friction_coefficient * normal_force, min(
        friction_coefficient * normal_force,
        pre(held_force) + stiffness * (held_displacement - pre(held_displacement))));
    end when;
    tangential_force = held_force;
    tangential_stiffness =
      if abs(held_force) < friction_coefficient * normal_force then stiffness else 0;
    contact_displacement = held_displacement - held_force / rig_stiffness;
  end StandIn;

  package Examples "Put the imported FMU in the place of the stand-in"
    extends Modelica.Icons.ExamplesPackage;

    model ShakenMass "A mass on a mount, held by the contact and driven by a force"
      extends Modelica.Icons.Example;
      replaceable StandIn fmu constrainedby ContactFmu;
      JointWithMass joint(m = 20);
      Modelica.Mechanics.Translational.Components.SpringDamper mount(c = 2e6, d = 1000);
      Modelica.Mechanics.Translational.Components.Fixed ground;
      Modelica.Mechanics.Translational.Sources.Force drive;
      Modelica.Blocks.Sources.Sine signal(amplitude = 70, f = 150);
      Modelica.Blocks.Sources.Constant load(k = 100);
    equation
      connect(load.y, fmu.normal_force);
      connect(load.y, joint.normal_force);
      connect(joint.tangential_displacement, fmu.tangential_displacement);
      connect(fmu.tangential_force, joint.tangential_force);
      connect(fmu.tangential_stiffness, joint.tangential_stiffness);
      connect(fmu.contact_displacement, joint.contact_displacement);
      connect(signal.y, drive.f);
      connect(drive.flange, joint.flange_a);
      connect(mount.flange_b, joint.flange_a);
      connect(ground.flange, mount.flange_a);
      connect(ground.flange, joint.flange_b);
      annotation(experiment(StopTime = 0.1, Tolerance = 1e-8));
    end ShakenMass;

    model SpringAndJoint "A spring without a mass between the drive and the contact"
      extends Modelica.Icons.Example;
      replaceable StandIn fmu constrainedby ContactFmu;
      Joint joint;
      Modelica.Mechanics.Translational.Components.Spring spring(c = 24e6);
      Modelica.Mechanics.Translational.Components.Fixed ground;
      Modelica.Mechanics.Translational.Sources.Position drive(exact = true);
      Modelica.Blocks.Sources.Sine signal(amplitude = 5e-6, f = 10);
      Modelica.Blocks.Sources.Constant load(k = 100);
    equation
      connect(load.y, fmu.normal_force);
      connect(load.y, joint.normal_force);
      connect(joint.tangential_displacement, fmu.tangential_displacement);
      connect(fmu.tangential_force, joint.tangential_force);
      connect(fmu.tangential_stiffness, joint.tangential_stiffness);
      connect(fmu.contact_displacement, joint.contact_displacement);
      connect(signal.y, drive.s_ref);
      connect(drive.flange, spring.flange_a);
      connect(spring.flange_b, joint.flange_a);
      connect(ground.flange, joint.flange_b);
      annotation(experiment(StopTime = 0.1, Tolerance = 1e-8));
    end SpringAndJoint;

    model RigAndJoint "The same spring as the rig stiffness of the FMU"
      extends Modelica.Icons.Example;
      replaceable StandIn fmu(rig_stiffness = 24e6) constrainedby ContactFmu;
      Joint joint(rig_stiffness = 24e6);
      Modelica.Mechanics.Translational.Components.Fixed ground;
      Modelica.Mechanics.Translational.Sources.Position drive(exact = true);
      Modelica.Blocks.Sources.Sine signal(amplitude = 5e-6, f = 10);
      Modelica.Blocks.Sources.Constant load(k = 100);
    equation
      connect(load.y, fmu.normal_force);
      connect(load.y, joint.normal_force);
      connect(joint.tangential_displacement, fmu.tangential_displacement);
      connect(fmu.tangential_force, joint.tangential_force);
      connect(fmu.tangential_stiffness, joint.tangential_stiffness);
      connect(fmu.contact_displacement, joint.contact_displacement);
      connect(signal.y, drive.s_ref);
      connect(drive.flange, joint.flange_a);
      connect(ground.flange, joint.flange_b);
      annotation(experiment(StopTime = 0.1, Tolerance = 1e-8));
    end RigAndJoint;
  end Examples;
  annotation(uses(Modelica(version = "4.0.0")));
end FrettingJoint;
