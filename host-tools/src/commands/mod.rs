//! The commands, one file each.

mod bench;
mod close_loop;
mod compare;
mod diagnose;
mod forward;
mod identify;
mod numbers;
mod observe;
mod replay;
mod run;
mod setup;
mod simulate;
mod soil_argument;
mod soils;
mod test;
mod train;
mod train_doubt;
mod weights;

use clap::Subcommand;

use crate::error::HostError;

/// What `kapvik` can be asked to do.
#[derive(Subcommand)]
pub enum Command {
    /// The main job: sensor frames through the flight image in QEMU to wheel forces and soil, with a report to open in a browser
    Run(run::Arguments),
    /// Find what a campaign's model lacks, train the rover network with it, and show the errors before and after
    ///
    /// Diagnoses the campaign, writes the declared model with the effect that was found to FOLDER/declared.toml, trains the
    /// rover network for the model as it was declared and for the one with the effect by the same plan, and prints the
    /// errors of forces and sinkage on held-out runs, of c, φ and K on simulated rovers on soil with the effect, and the
    /// intervals on the campaign's own soil.
    CloseLoop(close_loop::Arguments),
    /// Speed and quality, side by side with the alternatives, in one run
    #[command(subcommand)]
    Bench(bench::Subject),
    /// Wheel forces and soil from recorded sensor frames: the flight pipeline, frame by frame
    ///
    /// EST.csv has a row for each frame: slip, resistive torque, contact angle, normal load and drawbar pull of each wheel
    /// and the soil under the rover and under each wheel, each with its standard deviation; what is not known is empty.
    Replay(replay::Arguments),
    /// Cohesion, friction angle and shear modulus from a wheel campaign
    ///
    /// Rows with the same `run` and `t_s` are the wheels of one instant, and each run is one soil. Up to six rows of a run
    /// are taken as six wheels; more, of one instant or of many, are averaged in at most six groups of like slip and
    /// load (24 for methods other than the networks), and the method is told of the smaller noise. The noise is that of `[noise]`; without it that of repeats;
    /// without these that of the flight sensors. OUT.json says which.
    Identify(identify::Arguments),
    /// Every method of the literature on the same wheel states: error, interval, bias, refusals and time
    ///
    /// Six wheels at slips 0.05–0.60, with equal and spread loads, one instant and the mean of a hundred, on soils near and far
    /// from what the methods expect, with an effect that equations 1–11 lack; and measured figures whose soil is known.
    Compare(compare::Arguments),
    /// What the model lacks that wheel data show: the residual, the effect it is traced to, the error before and after
    ///
    /// Every effect of the list is fitted on top of the declared model, and has to predict runs that it has not seen better
    /// than the declared model refitted. OUT.json says which effect earned its place, how sure that is, and what was next.
    Diagnose(diagnose::Arguments),
    /// How to drive so that the soil shows: the manoeuvre that makes c, φ and K known at the least cost, computed
    ///
    /// Looks through what the rover can do: the wheels of each axle at rim speeds of their own, up and down a slope, one axle
    /// spinning on the spot, alone or two in turn. Slips and loads follow from the balance of the rover's forces, what they
    /// tell from the bound of Cramér and Rao with the noise of the rover's sensors, what of their errors lasts, and what is
    /// believed of the soil beforehand. Also draws for which spread of slip and load, number of wheels and averaging time each
    /// of them is known.
    Observe(observe::Arguments),
    /// Train the networks and write the frozen table
    Train(train::Arguments),
    /// Train the network that tells how far the estimators err, and write it as Rust source
    ///
    /// Drives simulated rovers, learns by how much the standard deviations that the filters state are to be multiplied, and
    /// prints how many errors lie within them before and after, on drives that took no part.
    TrainDoubt(train_doubt::Arguments),
    /// Drawbar pull, load, torque and sinkage of a wheel on a soil, by equations 1–11
    ///
    /// Each row of IN.csv gives `slip` (-1 to 1) and one of `sinkage_m` and `load_n`; the columns `drawbar_pull_n`,
    /// `load_n`, `torque_nm` and `sinkage_m` are filled in, appended where the table does not have them and computed
    /// anew where it does. Where a row gives both, the sinkage decides, and the load is computed like the rest. What
    /// decides, and every other column, stays as it was written. A row that gives neither, has no slip, or asks for a
    /// load that the soil cannot carry is an error: then nothing is written.
    Forward(forward::Arguments),
    /// A drive of a simulated rocker-bogie: frames of its sensors, and what was true beside
    ///
    /// Writes FRAMES.csv, one row a frame, and FRAMES.truth.csv. Soil, terrain, rim speeds and noise of a scenario are drawn
    /// from the seed; the same seed gives the same bytes.
    Simulate(simulate::Arguments),
    /// The catalogue of soils of the literature, with sources
    Soils,
    /// Find or install what the flight image is built and run with: the Arm target and QEMU
    Setup(setup::Arguments),
    /// Every test: host, firmware in QEMU, documentation
    Test(test::Arguments),
}

impl Command {
    /// Carries out the command.
    ///
    /// # Errors
    /// One that a person can act on: it names the file, line and column where there is one.
    pub fn execute(self) -> Result<(), HostError> {
        match self {
            Self::Run(arguments) => run::execute(&arguments),
            Self::Replay(arguments) => replay::execute(&arguments),
            Self::Identify(arguments) => identify::execute(&arguments),
            Self::Compare(arguments) => compare::execute(&arguments),
            Self::CloseLoop(arguments) => close_loop::execute(&arguments),
            Self::Bench(subject) => subject.execute(),
            Self::Diagnose(arguments) => diagnose::execute(&arguments),
            Self::Observe(arguments) => observe::execute(&arguments),
            Self::Train(arguments) => train::execute(&arguments),
            Self::TrainDoubt(arguments) => train_doubt::execute(&arguments),
            Self::Forward(arguments) => forward::execute(&arguments),
            Self::Simulate(arguments) => simulate::execute(&arguments),
            Self::Soils => soils::execute(),
            Self::Setup(arguments) => setup::execute(&arguments),
            Self::Test(arguments) => test::execute(&arguments),
        }
    }
}
