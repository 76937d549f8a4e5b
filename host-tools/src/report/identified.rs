//! What `identify` says of each run, for the terminal.

use crate::identify::{Document, ParameterDocument, RunDocument, SoilDocument};
use crate::parameter::Parameter;

use super::draw::number;
use super::terminal::wrapped;
use crate::terminal_table::{align_right, plain_table};

/// What the marks mean.
const LEGEND: &str = "value ± one standard deviation; ? = cannot be told from these data; ( ) = taken as given";

/// A line for each run.
pub fn identified(document: &Document) -> String {
    let mut table = plain_table();
    let [cohesion, friction, modulus] = Parameter::ALL.map(Parameter::titled);
    table.set_header(["run".to_owned(), cohesion, friction, modulus, String::new()]);
    for run in document.runs() {
        let [cohesion, friction, modulus] = soil_cells(&run.soil);
        let said = [Some(remark(run)).filter(|said| !said.is_empty()), run.left_out_in_words()];
        let said = said.into_iter().flatten().collect::<Vec<_>>().join("; ");
        table.add_row([run.run.clone(), cohesion, friction, modulus, said]);
    }
    align_right(&mut table);
    let mut text = format!("{table}\n  {LEGEND}");
    for warning in document.warnings() {
        text.push('\n');
        text += wrapped("• ", warning).trim_end();
    }
    text
}

/// Why there is no estimate, or none that can be relied on as the method states it.
pub fn remark(run: &RunDocument) -> String {
    let no_soil = run.no_soil.as_ref().map(|why| format!("not to be relied on: {why}"));
    let said = [&run.misfit, &run.beyond_training, &run.widened]
        .into_iter()
        .flatten()
        .chain(&run.remarks)
        .chain(&run.remembers);
    let said: Vec<&str> = said.map(String::as_str).collect();
    run.refused.clone().or(no_soil).unwrap_or_else(|| said.join("; "))
}

/// Cells of a soil: c (Pa), φ (°), K (mm).
pub fn soil_cells(soil: &SoilDocument) -> [String; 3] {
    [
        cell(soil.cohesion_pa.as_ref(), Parameter::Cohesion),
        cell(soil.friction_angle_rad.as_ref(), Parameter::FrictionAngle),
        cell(soil.shear_modulus_m.as_ref(), Parameter::ShearModulus),
    ]
}

fn cell(parameter: Option<&ParameterDocument>, kind: Parameter) -> String {
    let Some(told) = parameter else { return "–".to_owned() };
    let digits = kind.decimals();
    let figure = |value: f64| number(kind.shown(value), digits, false);
    let spread = told.std.map_or_else(String::new, |std| format!(" ± {}", figure(std)));
    let text = format!("{}{spread}", figure(told.value));
    match (told.assumed, told.identifiable) {
        (true, _) => format!("({text})"),
        (false, true) => text,
        (false, false) => format!("{text} ?"),
    }
}
