//! One QEMU with one image in it.

use std::io::{PipeReader, Read};
use std::os::unix::net::{UnixListener, UnixStream};
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{Child, Command};
use std::sync::mpsc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rustix::process::{Signal, set_parent_process_death_signal};

use crate::error::HostError;
use crate::process::command;
use crate::setup::Toolchain;

use super::log::Log;
use super::{Image, LogLine, LogView};

/// What drives the board's timers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clock {
    /// The time of day: the image runs as fast as QEMU can.
    Wall,
    /// The instructions that have been executed, one to a nanosecond: the same count at each run.
    Instructions,
}

/// A running QEMU. It is ended when this is dropped, and by the kernel should this process die first.
#[derive(Debug)]
pub struct Machine {
    child: Child,
    link: UnixStream,
    log: Log,
    /// Started QEMU and reads what it prints, until it ends.
    keeper: Option<JoinHandle<String>>,
}

/// How a QEMU ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ended {
    /// Its exit code; the image chooses it. `None` where a signal ended it.
    pub code: Option<i32>,
    /// What the image printed over semihosting, and QEMU itself.
    pub printed: String,
    /// The image's log.
    pub log: Vec<LogLine>,
}

/// How long QEMU may take to open its serial ports.
const START_PATIENCE: Duration = Duration::from_secs(30);
const POLL: Duration = Duration::from_millis(2);

/// A path among QEMU's options, which commas part unless they are doubled.
fn in_options(path: &Path) -> String {
    path.display().to_string().replace(',', ",,")
}

impl Machine {
    /// Starts an image. It runs once this returns, and nothing that it has sent is lost.
    ///
    /// # Errors
    /// Where QEMU cannot be started.
    pub fn start(toolchain: &Toolchain, image: &Image, clock: Clock, view: LogView) -> Result<Self, HostError> {
        let folder =
            tempfile::Builder::new().prefix("kapvik-").tempdir().map_err(HostError::file(&std::env::temp_dir()))?;
        let (link_path, log_path) = (folder.path().join("link"), folder.path().join("log"));
        let link_port = listen(&link_path)?;
        let log_port = listen(&log_path)?;
        let mut qemu = command(&toolchain.qemu);
        qemu.args(["-machine", "mps2-an386", "-cpu", "cortex-m4", "-nographic", "-monitor", "none"]);
        qemu.args(["-semihosting-config", "enable=on,target=native"]);
        for (name, path) in [("link", &link_path), ("log", &log_path)] {
            qemu.arg("-chardev").arg(format!("socket,id={name},server=off,path={}", in_options(path)));
            qemu.arg("-serial").arg(format!("chardev:{name}"));
        }
        if clock == Clock::Instructions {
            qemu.args(["-icount", "shift=0"]);
        }
        qemu.arg("-kernel").arg(image.path());
        let (mut child, keeper) = spawn_kept(qemu)?;
        let connected = accept(&link_port, &mut child).and_then(|link| {
            let log = accept(&log_port, &mut child)?;
            Ok((link, Log::follow(image, log, view).map_err(|error| error.to_string())?))
        });
        match connected {
            Ok((link, log)) => Ok(Self { child, link, log, keeper: Some(keeper) }),
            Err(reason) => {
                end(&mut child);
                let printed = keeper.join().unwrap_or_default();
                Err(HostError::Failed(format!("QEMU did not start: {reason} {}", printed.trim())))
            }
        }
    }

    /// Another handle to the host's end of the serial link.
    ///
    /// # Errors
    /// Where the system has no more handles.
    pub fn link(&self) -> Result<UnixStream, HostError> {
        self.link.try_clone().map_err(|error| HostError::Failed(format!("serial link: {error}")))
    }

    /// The number of QEMU's process.
    pub fn process_id(&self) -> u32 {
        self.child.id()
    }

    /// Ends QEMU and gives what the image had logged, whole.
    pub fn into_log(mut self) -> Vec<LogLine> {
        self.finish().log
    }

    /// Waits until the image ends itself.
    ///
    /// # Errors
    /// Where it does not in that time; it is ended then, and the text has its last lines.
    pub fn wait(mut self, patience: Duration) -> Result<Ended, HostError> {
        let deadline = Instant::now() + patience;
        let status = loop {
            match self.child.try_wait() {
                Ok(Some(status)) => break status,
                Ok(None) if Instant::now() < deadline => std::thread::sleep(POLL),
                _ => {
                    let ended = self.finish();
                    return Err(HostError::Failed(format!(
                        "QEMU was still running after {patience:?}\n{}",
                        tail(&ended)
                    )));
                }
            }
        };
        Ok(Ended { code: status.code(), ..self.finish() })
    }

    /// Ends QEMU, and says how it was: for the text of an error.
    pub fn post_mortem(mut self) -> String {
        let code = self.child.try_wait().ok().flatten().and_then(|status| status.code());
        let how = code.map_or("was still running".to_owned(), |code| format!("ended with exit code {code}"));
        format!("QEMU {how}\n{}", tail(&self.finish()))
    }

    /// Ends QEMU and collects what it left.
    fn finish(&mut self) -> Ended {
        end(&mut self.child);
        let log = self.log.finish();
        let printed = self.keeper.take().and_then(|keeper| keeper.join().ok()).unwrap_or_default();
        Ended { code: None, printed, log }
    }
}

impl Drop for Machine {
    fn drop(&mut self) {
        self.finish();
    }
}

/// The last lines of what was printed and logged.
fn tail(ended: &Ended) -> String {
    const LINES: usize = 12;
    let logged = ended.log.iter().map(|line| format!("  {} {}", line.level, line.text));
    let lines: Vec<String> = ended.printed.lines().map(|line| format!("  {line}")).chain(logged).collect();
    lines.get(lines.len().saturating_sub(LINES)..).unwrap_or(&[]).join("\n")
}

/// Starts a program from a thread that lives as long as it: the kernel ends the program when the thread that started
/// it dies, and other threads of this process come and go.
fn spawn_kept(mut program: Command) -> Result<(Child, JoinHandle<String>), HostError> {
    let name = program.get_program().to_string_lossy().into_owned();
    let (send, receive) = mpsc::channel();
    let keeper = std::thread::spawn(move || {
        let (child, output) = match spawn(&mut program) {
            Ok(started) => started,
            Err(error) => {
                // The receiver waits for exactly one message.
                let _ = send.send(Err(error));
                return String::new();
            }
        };
        // The pipe ends when its last writer does: this command must not be one.
        drop(program);
        let _ = send.send(Ok(child));
        read_to_end(output)
    });
    match receive.recv() {
        Ok(Ok(child)) => Ok((child, keeper)),
        Ok(Err(error)) => Err(HostError::Failed(format!("{name}: {error}"))),
        Err(error) => Err(HostError::Failed(format!("{name}: {error}"))),
    }
}

fn spawn(program: &mut Command) -> std::io::Result<(Child, PipeReader)> {
    let (output, input) = std::io::pipe()?;
    program.stdout(input.try_clone()?).stderr(input);
    // SAFETY: the closure runs between fork and exec and makes one system call, without touching memory or locks.
    unsafe { program.pre_exec(|| Ok(set_parent_process_death_signal(Some(Signal::KILL))?)) };
    Ok((program.spawn()?, output))
}

fn read_to_end(mut output: PipeReader) -> String {
    let mut bytes = Vec::new();
    // What was read before an error is still worth having.
    let _ = output.read_to_end(&mut bytes);
    String::from_utf8_lossy(&bytes).into_owned()
}

fn end(child: &mut Child) {
    // Both fail only where it has already ended.
    let _ = child.kill();
    let _ = child.wait();
}

fn listen(path: &Path) -> Result<UnixListener, HostError> {
    let listener = UnixListener::bind(path).map_err(HostError::file(path))?;
    listener.set_nonblocking(true).map_err(HostError::file(path))?;
    Ok(listener)
}

/// The connection that QEMU makes, unless it ends first or takes too long.
fn accept(listener: &UnixListener, child: &mut Child) -> Result<UnixStream, String> {
    let deadline = Instant::now() + START_PATIENCE;
    loop {
        match listener.accept() {
            Ok((stream, _)) => {
                stream.set_nonblocking(false).map_err(|error| error.to_string())?;
                return Ok(stream);
            }
            Err(error) if error.kind() != std::io::ErrorKind::WouldBlock => return Err(error.to_string()),
            Err(_) => (),
        }
        match child.try_wait() {
            Ok(None) if Instant::now() < deadline => std::thread::sleep(POLL),
            Ok(None) => return Err("it did not open its serial ports.".to_owned()),
            Ok(Some(status)) => return Err(format!("{status}.")),
            Err(error) => return Err(error.to_string()),
        }
    }
}
