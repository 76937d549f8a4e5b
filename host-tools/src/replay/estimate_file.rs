//! The file of estimates: one row for each frame, each number with its standard deviation.

use std::fmt::Arguments;
use std::io::Write;

use kapvik_firmware::estimator::{WheelActivity, WheelEstimate};
use kapvik_firmware::pipeline::FrameEstimate;
use kapvik_firmware::soil::{ParameterEstimate, SoilEstimate};

use crate::data::sensor_channels::WHEEL_NAMES;
use crate::data::time_column::write_seconds;
use crate::wheel_quantity::WheelQuantity;

/// A field of a row.
enum Field {
    Time(u64),
    Number(Option<f32>),
    Flag(bool),
    Count(Option<u16>),
    Word(&'static str),
}

/// Writes rows as they come.
pub struct EstimateWriter<W> {
    out: W,
    line: Vec<u8>,
}

impl<W: Write> EstimateWriter<W> {
    /// Writes the header.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn new(out: W) -> std::io::Result<Self> {
        let mut writer = Self { out, line: Vec::new() };
        writer.write_line(&FrameEstimate::nothing(), |line, name, _| write!(line, "{name}"))?;
        Ok(writer)
    }

    /// Writes the estimates of a frame: numbers as the shortest text that reads back as the same f32.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&mut self, estimate: &FrameEstimate) -> std::io::Result<()> {
        self.write_line(estimate, |line, _, field| field.write(line))
    }

    fn write_line(
        &mut self,
        estimate: &FrameEstimate,
        mut write_field: impl FnMut(&mut Vec<u8>, Arguments<'_>, Field) -> std::io::Result<()>,
    ) -> std::io::Result<()> {
        let line = &mut self.line;
        line.clear();
        let mut result = Ok(());
        fields(estimate, |name, field| {
            if !line.is_empty() {
                line.push(b',');
            }
            if let Err(error) = write_field(line, name, field) {
                result = Err(error);
            }
        });
        result?;
        line.push(b'\n');
        self.out.write_all(line)
    }
}

impl Field {
    fn write(self, out: &mut dyn Write) -> std::io::Result<()> {
        match self {
            Self::Time(time_us) => write_seconds(out, time_us),
            Self::Number(Some(number)) => write!(out, "{number:?}"),
            Self::Flag(flag) => write!(out, "{}", u8::from(flag)),
            Self::Count(Some(count)) => write!(out, "{count}"),
            Self::Word(word) => write!(out, "{word}"),
            Self::Number(None) | Self::Count(None) => Ok(()),
        }
    }
}

/// Every field of a row with its column's name, in the order of the columns.
fn fields(estimate: &FrameEstimate, mut put: impl FnMut(Arguments<'_>, Field)) {
    put(format_args!("t_s"), Field::Time(estimate.time_us));
    for (name, wheel) in WHEEL_NAMES.into_iter().zip(estimate.wheels.iter_wheels()) {
        wheel_fields(name, wheel, &mut put);
    }
    let soil = estimate.soil.as_ref().ok();
    soil_fields("", soil.map(|soil| &soil.estimate), &mut put);
    for (name, soil) in WHEEL_NAMES.into_iter().zip(estimate.wheel_soils.iter_wheels()) {
        soil_fields(&format!("_{name}"), soil.as_ref().ok(), &mut put);
    }
    for (name, wheel) in WHEEL_NAMES.into_iter().zip(estimate.wheels.iter_wheels()) {
        put(format_args!("slip_{name}_shared_std"), Field::Number(wheel.slip.map(|_| wheel.shared_slip_std)));
        put(format_args!("drawbar_pull_{name}_n_split_std"), Field::Number(Some(wheel.split_std_n)));
        put(format_args!("drawbar_pull_by_load_{name}_n"), Field::Number(Some(wheel.drawbar_pull_by_load_n)));
        put(format_args!("activity_{name}"), Field::Word(activity(wheel.activity)));
    }
    for (name, pull) in ["l", "r"].into_iter().zip(estimate.bogie_drawbar_pull_n.as_array()) {
        put(format_args!("drawbar_pull_bogie_{name}_n"), Field::Number(Some(pull.value)));
        put(format_args!("drawbar_pull_bogie_{name}_n_std"), Field::Number(Some(pull.std)));
    }
    put(format_args!("soil_changes"), Field::Count(soil.map(|soil| soil.changes)));
    put(format_args!("soil_instants"), Field::Number(soil.map(|soil| soil.instants)));
}

fn wheel_fields(name: &str, wheel: &WheelEstimate, put: &mut impl FnMut(Arguments<'_>, Field)) {
    for quantity in WheelQuantity::ALL {
        let ((before, behind), estimate) = (quantity.column(), quantity.estimate(wheel));
        put(format_args!("{before}{name}{behind}"), Field::Number(estimate.map(|estimate| estimate.value)));
        put(format_args!("{before}{name}{behind}_std"), Field::Number(estimate.map(|estimate| estimate.std)));
    }
}

fn soil_fields(after: &str, soil: Option<&SoilEstimate>, put: &mut impl FnMut(Arguments<'_>, Field)) {
    let mut parameter = |name: &str, of: fn(&SoilEstimate) -> &ParameterEstimate| {
        let parameter = soil.map(of);
        put(format_args!("{name}{after}"), Field::Number(parameter.map(|parameter| parameter.value)));
        put(format_args!("{name}{after}_std"), Field::Number(parameter.map(|parameter| parameter.std)));
        let identifiable = parameter.is_some_and(|parameter| parameter.identifiable);
        put(format_args!("{name}{after}_identifiable"), Field::Flag(identifiable));
    };
    parameter("cohesion_pa", |soil| &soil.cohesion_pa);
    parameter("friction_angle_rad", |soil| &soil.friction_angle_rad);
    parameter("shear_modulus_m", |soil| &soil.shear_modulus_m);
}

fn activity(activity: WheelActivity) -> &'static str {
    match activity {
        WheelActivity::Standing => "standing",
        WheelActivity::Rolling => "rolling",
        WheelActivity::Blocked => "blocked",
        WheelActivity::Lifted => "lifted",
    }
}

#[cfg(test)]
mod tests {
    use kapvik_firmware::estimator::Estimate;

    use super::*;

    fn written(estimates: &[FrameEstimate]) -> Vec<Vec<String>> {
        let mut bytes = Vec::new();
        let mut writer = EstimateWriter::new(&mut bytes).expect("written");
        estimates.iter().for_each(|estimate| writer.write(estimate).expect("written"));
        let text = String::from_utf8(bytes).expect("text");
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    }

    #[test]
    fn the_columns_are_those_that_were_agreed() {
        let header = &written(&[])[0];
        for name in [
            "t_s",
            "slip_fl",
            "slip_fl_std",
            "resistive_torque_ml_nm",
            "resistive_torque_ml_nm_std",
            "contact_angle_rr_rad_std",
            "normal_load_mr_n",
            "drawbar_pull_rl_n_std",
            "cohesion_pa",
            "friction_angle_rad_std",
            "shear_modulus_m_identifiable",
            "cohesion_pa_fr",
            "friction_angle_rad_fl_std",
            "shear_modulus_m_rr_identifiable",
        ] {
            assert_eq!(header.iter().filter(|column| *column == name).count(), 1, "{name}");
        }
        assert_eq!(header.len(), 1 + 6 * 10 + 7 * 9 + 6 * 4 + 4 + 2);
    }

    #[test]
    fn what_is_not_known_is_empty_and_numbers_read_back() {
        let mut estimate = FrameEstimate::nothing();
        estimate.time_us = 12_000_007;
        let tenth = Estimate { value: 0.1, std: 1.0e-9 };
        estimate.wheels.left.front.slip = Some(tenth);
        let rows = written(&[estimate]);
        let field = |name: &str| {
            let place = rows[0].iter().position(|column| column == name).expect("the column");
            rows[1][place].as_str()
        };
        assert_eq!(field("t_s"), "12.000007");
        assert_eq!(field("slip_fl").parse(), Ok(0.1_f32));
        assert_eq!(field("slip_fl_std").parse(), Ok(1.0e-9_f32));
        assert_eq!((field("slip_ml"), field("slip_ml_std")), ("", ""));
        assert_eq!((field("cohesion_pa"), field("cohesion_pa_identifiable"), field("soil_changes")), ("", "0", ""));
        assert_eq!(field("activity_rr"), "standing");
        assert_eq!(rows[1].len(), rows[0].len());
    }
}
