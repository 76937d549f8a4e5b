//! `kapvik soils`: the catalogue of soils as a table.

use comfy_table::CellAlignment;

use crate::error::HostError;
use crate::soil_catalogue::{CatalogueSoil, catalogue};
use crate::terminal_table::plain_table;

const HEADER: [&str; 12] =
    ["soil", "n", "k_c\nkPa/m^(n-1)", "k_phi\nkPa/m^n", "c\nkPa", "phi\n°", "K\nmm", "c1", "c2", "eta", "source", "id"];

/// Prints the catalogue.
///
/// # Errors
/// Where the data that is built in cannot be read.
pub fn execute() -> Result<(), HostError> {
    let soils = catalogue()?;
    let mut sources: Vec<&str> = Vec::new();
    let mut table = plain_table();
    table.set_header(HEADER);
    for soil in &soils {
        let known = sources.iter().position(|source| *source == soil.source);
        let source = known.unwrap_or_else(|| {
            sources.push(&soil.source);
            sources.len() - 1
        });
        table.add_row(cells(soil, source + 1));
    }
    table.column_iter_mut().skip(1).take(9).for_each(|column| column.set_cell_alignment(CellAlignment::Right));
    println!("{table}");
    println!("– not in the source   † assumed by the source   * Reece's form, see below\n");
    for (place, source) in sources.iter().enumerate() {
        println!("[{}] {source}", place + 1);
    }
    println!();
    for soil in &soils {
        if let Some(reece) = soil.reece_wheel {
            println!(
                "* {}: p = (k1 + k2 b)(z/b)^n, k1 = {} lb/in², k2 = {} lb/in³, b = {} m",
                soil.id, reece.k1_psi, reece.k2_psi_in, reece.width_m
            );
        }
        if let Some(reece) = soil.reece {
            println!(
                "* {}: p = (c k'c + γ b k'phi)(z/b)^n, k'c = {}, k'phi = {}, density {} kg/m³",
                soil.id, reece.k_c, reece.k_phi, reece.density_kg_m3
            );
        }
        if let Some(note) = &soil.note {
            println!("{}: {note}", soil.id);
        }
    }
    Ok(())
}

fn cells(soil: &CatalogueSoil, source: usize) -> [String; 12] {
    let show = |key: &str, figure: Option<String>| match figure {
        Some(figure) if soil.assumed.iter().any(|assumed| assumed == key) => format!("{figure}†"),
        Some(figure) => figure,
        None => "–".to_owned(),
    };
    let modulus = |key: &str, modulus: Option<f64>| match modulus {
        None if soil.reece_wheel.is_some() || soil.reece.is_some() => "*".to_owned(),
        modulus => show(key, modulus.map(|modulus| modulus.to_string())),
    };
    [
        soil.name.clone(),
        show("n", soil.n.map(|n| n.to_string())),
        modulus("k_c", soil.k_c_kpa),
        modulus("k_phi", soil.k_phi_kpa),
        show("c", soil.c_kpa.map(|c| c.to_string())),
        show("phi", soil.phi_deg.map(|phi| phi.to_string())),
        show("K", soil.shear_modulus_mm.map(|k| k.to_string())),
        show("c1", soil.c1.map(|c1| c1.to_string())),
        show("c2", soil.c2.map(|c2| c2.to_string())),
        show("eta", soil.eta.map(|eta| eta.to_string())),
        format!("[{source}]"),
        soil.id.clone(),
    ]
}
