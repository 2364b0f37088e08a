within;
package Modelica "The classes of the standard library that FrettingJoint uses, for its tests"
  package Units
    package SI
      type Position = Real(final quantity = "Length", final unit = "m");
      type Velocity = Real(final quantity = "Velocity", final unit = "m/s");
      type Force = Real(final quantity = "Force", final unit = "N");
      type Mass = Real(final quantity = "Mass", final unit = "kg", min = 0);
      type Time = Real(final quantity = "Time", final unit = "s");
    end SI;
  end Units;

  package Constants
    constant Real pi = 3.141592653589793;
  end Constants;

  package Icons
    partial package Package
    end Package;
    partial package ExamplesPackage
    end ExamplesPackage;
    partial model Example
    end Example;
  end Icons;

  package Blocks
    package Interfaces
      connector RealInput = input Real;
      connector RealOutput = output Real;
    end Interfaces;

    package Sources
      block Constant
        parameter Real k(start = 1);
        Interfaces.RealOutput y;
      equation
        y = k;
      end Constant;

      block Sine
        parameter Real amplitude = 1;
        parameter Real f(unit = "Hz", start = 1);
        Interfaces.RealOutput y;
      equation
        y = amplitude * sin(2 * Constants.pi * f * time);
      end Sine;
    end Sources;
  end Blocks;

  package Mechanics
    package Translational
      package Interfaces
        connector Flange_a
          Units.SI.Position s;
          flow Units.SI.Force f;
        end Flange_a;

        connector Flange_b
          Units.SI.Position s;
          flow Units.SI.Force f;
        end Flange_b;
      end Interfaces;

      package Components
        model Fixed
          parameter Units.SI.Position s0 = 0;
          Interfaces.Flange_b flange;
        equation
          flange.s = s0;
        end Fixed;

        model Spring
          parameter Real c(unit = "N/m");
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
        equation
          flange_b.f = c * (flange_b.s - flange_a.s);
          flange_a.f = -flange_b.f;
        end Spring;

        model SpringDamper
          parameter Real c(unit = "N/m");
          parameter Real d(unit = "N.s/m");
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
          Units.SI.Position s_rel;
        equation
          s_rel = flange_b.s - flange_a.s;
          flange_b.f = c * s_rel + d * der(s_rel);
          flange_a.f = -flange_b.f;
        end SpringDamper;
      end Components;

      package Sources
        model Force
          Interfaces.Flange_b flange;
          Blocks.Interfaces.RealInput f;
        equation
          flange.f = -f;
        end Force;

        model Position
          parameter Boolean exact = false;
          Interfaces.Flange_b flange;
          Blocks.Interfaces.RealInput s_ref;
        equation
          flange.s = s_ref;
        end Position;
      end Sources;
    end Translational;
  end Mechanics;
end Modelica;
