use super::super::shear_law::{AlteredShear, Hump, PlainShear, ShearConditions};
use super::super::shear_stress::{Cap, Mobilisation, Strength};
use super::super::{Contact, Quadrature, Soil, Wheel};
use super::*;
use crate::terramechanics::integrals::{carried, integrate};
use crate::terramechanics::normal_stress::NormalStress;
use crate::terramechanics::shear_displacement::ShearDisplacement;

/// Slip, sinkage, eight parameters of the soil, and six of an altered law.
const INPUTS: usize = 16;
const SLIP: usize = 0;
const MODULUS: usize = 7;
type Slopes = Dual<f64, INPUTS>;

/// Which parts of an altered law there are.
#[derive(Clone, Copy, Default)]
struct Altered {
    radius: bool,
    sideways: bool,
    cap: bool,
    hump: bool,
}

/// By name, as slip and K have limits of their own.
struct Case {
    slip: f64,
    modulus_m: f64,
    altered: Altered,
}

const PLAIN: Altered = Altered { radius: false, sideways: false, cap: false, hump: false };

const CASES: [Case; 11] = [
    Case { slip: 0.3, modulus_m: 0.012, altered: PLAIN },
    Case { slip: 0.0, modulus_m: 0.012, altered: PLAIN },
    Case { slip: -0.25, modulus_m: 0.012, altered: PLAIN },
    Case { slip: -1.0, modulus_m: 0.012, altered: PLAIN },
    Case { slip: 0.3, modulus_m: 0.0, altered: PLAIN },
    Case { slip: 0.3, modulus_m: 0.012, altered: Altered { sideways: true, ..PLAIN } },
    Case { slip: -0.25, modulus_m: 0.012, altered: Altered { sideways: true, ..PLAIN } },
    Case { slip: 0.3, modulus_m: 0.012, altered: Altered { cap: true, ..PLAIN } },
    Case { slip: 0.3, modulus_m: 0.012, altered: Altered { hump: true, ..PLAIN } },
    Case { slip: 0.3, modulus_m: 0.012, altered: Altered { radius: true, ..PLAIN } },
    Case { slip: -0.1, modulus_m: 0.012, altered: Altered { radius: true, sideways: true, cap: true, hump: true } },
];

impl Case {
    fn inputs(&self) -> [f64; INPUTS] {
        let soil = [1.05, 1.2e6, 400.0, 0.55, 0.4, self.modulus_m, 0.15, 0.1];
        let [exponent, stiffness, cohesion, friction, c1, modulus, c2, rebound] = soil;
        [
            self.slip, 0.012, exponent, stiffness, cohesion, friction, c1, modulus, c2, rebound, 1.08, 0.2, 250.0,
            0.35, 0.6, 0.7,
        ]
    }

    /// The integrals in the order of their fields, in the library's way or with slopes carried through every operation.
    fn integrals<S: Scalar>(&self, inputs: [S; INPUTS], is_carried: bool) -> [S; 4] {
        let [slip, sinkage_m, exponent, stiffness, cohesion, friction, c1, modulus, c2, rebound, rest @ ..] = inputs;
        let [ratio, tan_slip_angle, adhesion_pa, tan, share, residual] = rest;
        let wheel = Wheel { radius_m: S::constant(0.15), width_m: S::constant(0.1) };
        let soil = Soil {
            sinkage_exponent: exponent,
            cohesive_modulus: S::zero(),
            frictional_modulus: stiffness,
            cohesion_pa: cohesion,
            friction_angle_rad: friction,
            shear_modulus_m: modulus,
            peak_stress_c1: c1,
            peak_stress_c2: c2,
            rebound_ratio: rebound,
        };
        let conditions = ShearConditions {
            radius_ratio: self.altered.radius.then_some(ratio),
            tan_slip_angle: self.altered.sideways.then_some(tan_slip_angle),
            cap: self.altered.cap.then_some(Cap { adhesion_pa, tan }),
            hump: self.altered.hump.then_some(Hump { share, residual }),
        };
        let contact = Contact::new(&wheel, &soil, slip, sinkage_m);
        let displacement = ShearDisplacement::new(slip);
        let mobilisation = Mobilisation::new(&soil, wheel.radius_m, &displacement);
        let place = Place {
            contact: &contact,
            normal: &NormalStress::new(&wheel, &soil),
            displacement: &displacement,
            strength: &Strength::new(&soil, conditions.cap),
            layer: mobilisation.scale,
        };
        let found = if conditions.is_plain() {
            by_law(&place, &PlainShear { mobilisation }, is_carried)
        } else {
            by_law(&place, &AlteredShear::new(&displacement, mobilisation, &conditions, &contact), is_carried)
        };
        [found.pull, found.load, found.torque, found.side]
    }

    fn with_slopes(&self, is_carried: bool) -> [Slopes; 4] {
        let inputs = self.inputs();
        self.integrals(core::array::from_fn(|k| Slopes::variable(inputs[k], k)), is_carried)
    }
}

fn by_law<S: Scalar>(place: &Place<'_, S>, law: &impl ShearLaw<S>, is_carried: bool) -> Integrals<S> {
    let quadrature = Quadrature::REFERENCE;
    if is_carried {
        carried(&quadrature, &place.panels(&quadrature), place, law)
    } else {
        integrate(&quadrature, place, law)
    }
}

#[test]
fn slopes_are_those_carried_through_every_operation() {
    for (number, case) in CASES.iter().enumerate() {
        let bare = case.integrals(case.inputs(), false);
        assert_eq!(bare, case.with_slopes(false).map(|integral| integral.value), "case {number}");
        for (chained, carried) in case.with_slopes(false).iter().zip(case.with_slopes(true)) {
            assert_eq!(chained.value, carried.value, "case {number}");
            for (input, (chained, carried)) in chained.slopes.iter().zip(carried.slopes).enumerate() {
                // In units of what the sum is made of: where it cancels, its rounding stays.
                let size = carried.abs().max(1e-2 * case.with_slopes(true)[1].slopes[input].abs());
                assert!((chained - carried).abs() <= 1e-10 * size, "case {number}, input {input}: {chained} {carried}");
            }
        }
    }
}

#[test]
fn slopes_are_the_limits_of_differences() {
    for (number, case) in CASES.iter().enumerate() {
        let slopes = case.with_slopes(false);
        let inputs = case.inputs();
        for input in 0..INPUTS {
            // At the ends of their ranges, slip and K have slopes on one side alone; and so has the slip where it changes sign.
            let at_end = (input == SLIP && (case.slip == -1.0 || case.slip == 0.0))
                || (input == MODULUS && case.modulus_m == 0.0);
            if at_end {
                continue;
            }
            let step = 1e-5 * inputs[input].abs();
            let at = |sign: f64| {
                let mut moved = inputs;
                moved[input] += sign * step;
                case.integrals(moved, false)
            };
            let (above, below) = (at(1.0), at(-1.0));
            for channel in 0..4 {
                let difference = (above[channel] - below[channel]) / (2.0 * step);
                let slope = slopes[channel].slopes[input];
                let size = difference.abs().max(1e-3 * slopes[1].value.abs() / inputs[input].abs());
                assert!(
                    (slope - difference).abs() <= 1e-4 * size,
                    "case {number}, channel {channel}, input {input}: {slope} {difference}"
                );
            }
        }
    }
}

/// The seed's law is the altered one that nothing alters, and asks for nothing along the axle.
#[test]
fn the_sizes_of_the_law_agree() {
    let plain = Case { altered: PLAIN, ..CASES[0] };
    // A hump that no part of the soil has, in the greatest size.
    let mut inputs = plain.inputs();
    inputs[14] = 0.0;
    let neutral = Case { altered: Altered { hump: true, ..PLAIN }, ..CASES[0] };
    let neutral = neutral.integrals(core::array::from_fn(|k| Slopes::variable(inputs[k], k)), false);
    for (plain, neutral) in plain.with_slopes(false).iter().zip(neutral) {
        assert!((plain.value - neutral.value).abs() <= 1e-12 * plain.value.abs());
        for input in 0..10 {
            let (plain, neutral) = (plain.slopes[input], neutral.slopes[input]);
            assert!((plain - neutral).abs() <= 1e-9 * plain.abs(), "input {input}: {plain} {neutral}");
        }
    }
}
