//! Findings made up for tests: real readings, invented predictions.

use std::collections::BTreeMap;

use super::findings::DiagnosisFindings;
use crate::data::campaign::{Campaign, Carried, Channel};
use crate::diagnose::document::{
    Candidate, ChannelErrors, Diagnosis, EndsApart, ErrorPair, Estimate, FoundEffect, FoundLaw, LeftOut, LevelsLeftOut,
    RunnerUp, Unexplained, Verdict,
};
use crate::diagnose::{Trace, Traced};

/// Two effects found on the steady runs, with something in every list.
pub fn findings() -> DiagnosisFindings {
    let campaign = Carried::CmuSmoothStraight.campaign().expect("the project's own figures");
    let curve = |slip: f64, of: [f64; 3]| of[0] + of[1] * slip + of[2] * slip * slip;
    let traces = vec![
        trace(&campaign, Channel::DrawbarPull, |slip| (curve(slip, [-1.3, 4.0, -0.6]), curve(slip, [-1.3, 6.1, -3.5]))),
        trace(&campaign, Channel::Load, |_| (24.9, 24.7)),
        trace(&campaign, Channel::SideForce, |_| (0.0, 0.0)),
        trace(&campaign, Channel::Sinkage, |slip| {
            (curve(slip, [0.0205, 0.0015, 0.0]), curve(slip, [0.0142, 0.0245, -0.012]))
        }),
    ];
    DiagnosisFindings::new(&campaign, diagnosis(&campaign), traces, Some("slip".to_owned()))
}

fn trace(campaign: &Campaign, channel: Channel, predicted: impl Fn(f64) -> (f64, f64)) -> Trace {
    let noise = campaign.noise.of(channel).unwrap_or(0.4);
    let row = |row| {
        let slip = campaign.value(row, Channel::Slip).filter(|slip| *slip > -0.05)?;
        let (before, after) = predicted(slip);
        let measured = campaign.value(row, channel)?;
        Some(Traced { measured, noise, before: Some(before), after: Some(after) })
    };
    Trace { channel: channel.name().to_owned(), rows: (0..campaign.rows().len()).map(row).collect() }
}

fn diagnosis(campaign: &Campaign) -> Diagnosis {
    let one = |name: &str, value, std| BTreeMap::from([(name.to_owned(), Estimate { value, std })]);
    let pair = |rmse_before, rmse_after| ErrorPair { rmse_before, rmse_after };
    let soil = |entries: [(&str, f64, f64); 5]| -> BTreeMap<String, Estimate> {
        entries.into_iter().map(|(key, value, std)| (key.to_owned(), Estimate { value, std })).collect()
    };
    let channels = |z, pull| BTreeMap::from([("sinkage_m".to_owned(), z), ("drawbar_pull_n".to_owned(), pull)]);
    Diagnosis {
        campaign: campaign.name.clone(),
        data: None,
        declared: Vec::new(),
        declared_effects: Vec::new(),
        verdict: Verdict::Effect,
        sentence:
            "The sinkage grows with slip, which the model lacks: with slip-sinkage the error of the sinkage on runs \
                   that it did not know falls from 4.1 to 1.1 mm."
                .to_owned(),
        effects: vec![
            FoundEffect {
                id: "slip-sinkage".to_owned(),
                form: "stretch, saturating".to_owned(),
                parameters: BTreeMap::from([
                    ("stretch".to_owned(), Estimate { value: 1.312, std: 0.128 }),
                    ("saturation".to_owned(), Estimate { value: 2.41, std: 0.62 }),
                ]),
                gain_per_row: 2.31,
                p_value: 2.3e-7,
                ambiguous_with: vec!["rate".to_owned()],
            },
            FoundEffect {
                id: "guide-friction".to_owned(),
                form: "load".to_owned(),
                parameters: one("mu", 0.135, 0.015),
                gain_per_row: 0.21,
                p_value: 0.0042,
                ambiguous_with: vec!["crosstalk".to_owned()],
            },
        ],
        runner_up: Some(RunnerUp { id: "load-stiffening".to_owned(), form: String::new(), gain_per_row: 0.4 }),
        ambiguous_with: vec!["rate".to_owned()],
        deciding_measurement: Some("Repeat a slip of 0.5 at 30 mm/s in place of 10 mm/s.".to_owned()),
        force_channels: vec![FoundEffect {
            id: "force-drift".to_owned(),
            form: "side force with hours".to_owned(),
            parameters: one("side_force_n_per_h", 0.232, 0.048),
            gain_per_row: 0.47,
            p_value: 0.00052,
            ambiguous_with: Vec::new(),
        }],
        unexplained: vec![Unexplained {
            channel: "side_force_n".to_owned(),
            regressor: "hours_since_zero".to_owned(),
            share_of_variance: 0.23,
            p_value: 0.0061,
        }],
        found_law: Some(FoundLaw {
            channel: "side_force_n".to_owned(),
            formula: "side_force_n += 0.014 W sqrt(hours_since_zero/1 h)".to_owned(),
            coefficient: Estimate { value: 0.014, std: 0.003 },
            gain_per_row: 0.19,
        }),
        channels: BTreeMap::from([
            ("sinkage_m".to_owned(), errors(0.0041, 0.0011, 0.0007, true)),
            ("drawbar_pull_n".to_owned(), errors(0.92, 0.61, 0.6, true)),
            ("load_n".to_owned(), errors(1.15, 1.1, 0.9, true)),
            ("side_force_n".to_owned(), errors(0.62, 0.61, 0.4, false)),
        ]),
        leave_level_out: Some(LevelsLeftOut {
            slips: vec![0.0, 0.23, 0.5, 0.75, 0.9],
            channels: channels(pair(0.0046, 0.0021), pair(1.4, 0.8)),
        }),
        ends_apart: Some(EndsApart {
            runs: ["v010-a", "v100-c"].map(str::to_owned).to_vec(),
            ends: channels(pair(0.006, 0.002), pair(1.5, 0.9)),
            between: channels(pair(0.003, 0.0009), pair(0.8, 0.55)),
        }),
        soil_before: soil([
            ("n", 1.31, 0.07),
            ("k_eff", 2.1e6, 0.6e6),
            ("c", 480.0, 290.0),
            ("phi", 0.41, 0.05),
            ("K", 0.009, 0.003),
        ]),
        soil_after: soil([
            ("n", 1.28, 0.07),
            ("k_eff", 4.4e6, 1.3e6),
            ("c", 390.0, 270.0),
            ("phi", 0.47, 0.05),
            ("K", 0.012, 0.004),
        ]),
        candidates: candidates(),
        held_out_runs: campaign.runs().iter().map(|(run, _)| (*run).to_owned()).collect(),
        left_out: vec![LeftOut { reason: "slip below −0.05: the wheel is dragged".to_owned(), rows: 12 }],
        caveats: campaign.notes.clone(),
    }
}

fn errors(rmse_before: f64, rmse_after: f64, noise: f64, noise_stated: bool) -> ChannelErrors {
    let [rmse_before, rmse_after] = [rmse_before, rmse_after].map(Some);
    ChannelErrors { rmse_before, rmse_after, noise, noise_with_sinkage: None, noise_stated, runs: 15 }
}

/// Fewer gains, and less sure, down the list; the last are worse than nothing.
fn candidates() -> Vec<Candidate> {
    let first = [
        ("slip-sinkage", "stretch, saturating"),
        ("rate", "stiffness follows the speed of the rim"),
        ("slip-sinkage", "exponent"),
        ("load-stiffening", ""),
        ("bulldozing", ""),
        ("peak-stress-shift", "constant"),
        ("rear-contact", ""),
        ("multi-pass", ""),
        ("shear-hump", ""),
        ("interface-friction", ""),
        ("rolling-radius", ""),
        ("sinkage-reference", ""),
        ("force-bias", "drawbar_pull_n"),
        ("force-bias", "load_n"),
        ("crosstalk", "drawbar_pull_n into load_n"),
        ("pitch-misalignment", "constant"),
    ];
    let second = [("guide-friction", "load"), ("crosstalk", "drawbar_pull_n into load_n"), ("rear-contact", "")];
    let candidate = |step, (place, (id, form)): (usize, (&str, &str)), best: f64| {
        let gain_per_row = best * (1.0 - 0.32 * place as f64).max(-3.0) / (1.0 + 0.25 * place as f64);
        Candidate {
            step,
            id: id.to_owned(),
            form: form.to_owned(),
            gain_per_row,
            gain_std: 0.12 + 0.1 * gain_per_row.abs(),
            p_value: (gain_per_row > 0.0).then(|| 10_f64.powf(-3.0 * gain_per_row - 0.5)),
            parameters: BTreeMap::new(),
        }
    };
    let first = first.into_iter().enumerate().map(|entry| candidate(1, entry, 2.31));
    first.chain(second.into_iter().enumerate().map(|entry| candidate(2, entry, 0.6))).collect()
}
