//! The trained network as Rust source.

use kapvik_firmware::estimator::doubt::DoubtNetwork;
use kapvik_firmware::network::checksum;

use super::drives::Plan;
use super::held_out::BeforeAfter;

/// What stands in the file beside the numbers.
#[derive(Debug, Clone, Copy)]
pub struct Provenance<'a> {
    /// The drives that it was trained on.
    pub plan: &'a Plan,
    /// How it does on those that were held out.
    pub held_out: &'a BeforeAfter,
}

/// The module that freezes the network: the `Debug` text of its layers is Rust source.
pub fn source(network: &DoubtNetwork, provenance: &Provenance<'_>) -> String {
    let Provenance { plan: Plan { seed, drives }, held_out: BeforeAfter { before, after } } = provenance;
    let (before, after) = (before.mean_loss(), after.mean_loss());
    format!(
        "//! The weights of the network that tells how much larger errors are than the filters know.\n\
         //!\n\
         //! Made by `cargo kapvik train-doubt --seed {seed} --drives {drives} --output FILE`; with the same estimators and\n\
         //! simulator it gives the same bytes. Loss of a row on held-out drives: {after:.4}, where the filters are believed {before:.4}.\n\
         \n\
         use super::DoubtNetwork;\n\
         use crate::network::fixed_point::{{FixedLayer, Pair}};\n\
         \n\
         #[rustfmt::skip] // the weights of two inputs a line\n\
         pub(super) static NETWORK: DoubtNetwork = {};\n\n\
         /// CRC-32 of these weights.\n\
         pub(super) const CHECKSUM: u32 = {:#010x};\n",
        in_lines(&format!("{network:?}")),
        checksum(network)
    )
}

/// `Debug` text in lines that can be looked at.
fn in_lines(text: &str) -> String {
    let broken = text.replace("{ ", "{\n").replace(" }", "\n}").replace("], ", "],\n").replace("}, ", "},\n");
    let mut depth = 0;
    let indented = broken.lines().map(|line| {
        depth -= line.matches('}').count();
        let indent = 4 * depth;
        depth += line.matches('{').count();
        format!("{:indent$}{line}", "")
    });
    indented.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::doubt::weights::DoubtWeights;
    use kapvik_firmware::estimator::doubt::{HIDDEN, INPUTS, OUTPUTS};

    fn without_space(text: &str) -> String {
        text.split_whitespace().collect()
    }

    #[test]
    fn the_source_holds_every_number() {
        let mut weights = DoubtWeights::initial(3);
        weights.output.bias[2] = -0.5;
        let network = weights.rounded(&[0.0; INPUTS]);
        let plan = Plan { seed: 7, drives: 9 };
        let text = source(&network, &Provenance { plan: &plan, held_out: &BeforeAfter::default() });
        assert!(text.contains("--seed 7 --drives 9"));
        let (text_of_weights, after) = text.split_once("/// CRC").expect("a checksum");
        assert!(after.ends_with(&format!(" = {:#010x};\n", checksum(&network))), "{after}");
        let (_, value) = text_of_weights.split_once("static NETWORK: DoubtNetwork =").expect("the static");
        assert_eq!(without_space(value), without_space(&format!("{network:?};")));
        assert_eq!(value.matches("Pair(").count(), HIDDEN * (INPUTS + OUTPUTS) / 2);
        assert!(text.lines().all(|line| line.chars().count() <= 120 && line.trim_end() == line), "{text}");
    }
}
