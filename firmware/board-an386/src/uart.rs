//! The board's serial ports (Arm CMSDK APB UART): UART0 receives by interrupt and carries the link, UART1 only sends
//! and carries the log.

use core::cell::UnsafeCell;
use core::ptr::{read_volatile, write_volatile};
use core::sync::atomic::{AtomicBool, Ordering};

use cortex_m::interrupt::InterruptNumber;
use cortex_m::peripheral::NVIC;
use critical_section::CriticalSection;
use embedded_io::{ErrorType, Read, ReadReady, Write};
use heapless::spsc::Queue;

/// The number of UART0's receive interrupt.
pub(crate) const RECEIVE_INTERRUPT: u16 = 0;

const UART0: Registers = Registers(0x4000_4000);
const UART1: Registers = Registers(0x4000_5000);

const TRANSMIT_FULL: u32 = 1 << 0;
const RECEIVE_FULL: u32 = 1 << 1;
const RECEIVE_OVERRUN: u32 = 1 << 3;

const TRANSMIT_ENABLE: u32 = 1 << 0;
const RECEIVE_ENABLE: u32 = 1 << 1;
const RECEIVE_INTERRUPT_ENABLE: u32 = 1 << 3;
/// That something was received, among the interrupts.
const RECEIVED_INTERRUPT: u32 = 1 << 1;

/// The least divider that the device accepts: 25 MHz / 16.
const BAUD_DIVIDER: u32 = 16;

/// How often the link asks whether the port is free before it gives a byte up. Far longer than a byte takes.
const TRANSMIT_POLLS: u32 = 50_000_000;

/// The registers of one port, at this address.
#[derive(Clone, Copy)]
struct Registers(usize);

impl Registers {
    fn read(self, offset: usize) -> u32 {
        // SAFETY: the address of a register of the device; reading DATA takes a byte, which is what callers want.
        unsafe { read_volatile((self.0 + offset) as *const u32) }
    }
    fn write(self, offset: usize, value: u32) {
        // SAFETY: the address of a register of the device.
        unsafe { write_volatile((self.0 + offset) as *mut u32, value) }
    }
    fn data(self) -> u8 {
        (self.read(0x00) & 0xff) as u8
    }
    fn send(self, byte: u8) {
        self.write(0x00, u32::from(byte));
    }
    fn state(self) -> u32 {
        self.read(0x04)
    }
    fn clear_state(self, bits: u32) {
        self.write(0x04, bits);
    }
    fn control(self, bits: u32) {
        self.write(0x08, bits);
    }
    fn clear_interrupts(self, bits: u32) {
        self.write(0x0c, bits);
    }
    fn baud_divider(self, divider: u32) {
        self.write(0x10, divider);
    }
}

/// What the interrupt has received and the link has not yet read.
struct Received(UnsafeCell<Queue<u8, 1024>>);

// SAFETY: used through `Received::with` alone, which asks for a critical section.
unsafe impl Sync for Received {}

static RECEIVED: Received = Received(UnsafeCell::new(Queue::new()));

impl Received {
    fn with<R>(&self, _: CriticalSection<'_>, action: impl FnOnce(&mut Queue<u8, 1024>) -> R) -> R {
        // SAFETY: interrupts are off and there is one core, so this is the only reference while `action` runs; no
        // `action` in this file calls `with` again.
        action(unsafe { &mut *self.0.get() })
    }
}

/// UART0's receive interrupt as the NVIC knows it.
#[derive(Clone, Copy)]
struct ReceiveInterrupt;

// SAFETY: the number is that of the board's UART0 receive interrupt.
unsafe impl InterruptNumber for ReceiveInterrupt {
    fn number(self) -> u16 {
        RECEIVE_INTERRUPT
    }
}

/// Moves what has arrived into the queue. When the queue is full the interrupt is left off until it has been read.
pub(crate) fn on_receive() {
    critical_section::with(|section| {
        RECEIVED.with(section, |queue| {
            UART0.clear_interrupts(RECEIVED_INTERRUPT);
            while UART0.state() & RECEIVE_FULL != 0 {
                if queue.is_full() {
                    UART0.control(TRANSMIT_ENABLE | RECEIVE_ENABLE);
                    break;
                }
                // The queue has room: it was asked just above.
                let _ = queue.enqueue(UART0.data());
            }
        });
    });
}

/// A serial port could not do what was asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, defmt::Format)]
pub enum UartError {
    /// Bytes came faster than they were taken; some are lost.
    Overrun,
    /// The port did not become free.
    TransmitStuck,
}

impl core::fmt::Display for UartError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Overrun => "receive overrun",
            Self::TransmitStuck => "transmitter stuck",
        })
    }
}

impl core::error::Error for UartError {}

impl embedded_io::Error for UartError {
    fn kind(&self) -> embedded_io::ErrorKind {
        match self {
            Self::Overrun => embedded_io::ErrorKind::Other,
            Self::TransmitStuck => embedded_io::ErrorKind::TimedOut,
        }
    }
}

/// UART0, the link.
pub struct LinkUart(());

static TAKEN: AtomicBool = AtomicBool::new(false);

impl LinkUart {
    /// Starts the clock of the log, both ports and the receive interrupt. `None` if it was taken before.
    pub fn take() -> Option<Self> {
        if critical_section::with(|_| {
            let taken = TAKEN.load(Ordering::Relaxed);
            TAKEN.store(true, Ordering::Relaxed);
            taken
        }) {
            return None;
        }
        crate::ticks::count_microseconds();
        start_log();
        UART0.baud_divider(BAUD_DIVIDER);
        listen();
        // SAFETY: the handler is in place, and no critical section is open that the interrupt would break.
        unsafe { NVIC::unmask(ReceiveInterrupt) };
        Some(Self(()))
    }

    /// Sleeps until an interrupt, unless something is waiting to be read.
    pub fn wait(&mut self) {
        critical_section::with(|section| {
            if RECEIVED.with(section, |queue| queue.is_empty()) {
                // An interrupt that comes between the question and this line is pending, and pending is enough to wake.
                cortex_m::asm::wfi();
            }
        });
    }
}

/// Receives by interrupt.
fn listen() {
    UART0.control(TRANSMIT_ENABLE | RECEIVE_ENABLE | RECEIVE_INTERRUPT_ENABLE);
}

impl ErrorType for LinkUart {
    type Error = UartError;
}

impl ReadReady for LinkUart {
    fn read_ready(&mut self) -> Result<bool, UartError> {
        if UART0.state() & RECEIVE_OVERRUN != 0 {
            UART0.clear_state(RECEIVE_OVERRUN);
            return Err(UartError::Overrun);
        }
        Ok(critical_section::with(|section| RECEIVED.with(section, |queue| !queue.is_empty())))
    }
}

impl Read for LinkUart {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, UartError> {
        if buffer.is_empty() {
            return Ok(0);
        }
        while !self.read_ready()? {
            self.wait();
        }
        let count = critical_section::with(|section| {
            RECEIVED.with(section, |queue| {
                buffer.iter_mut().map_while(|slot| queue.dequeue().map(|byte| *slot = byte)).count()
            })
        });
        listen();
        // A byte that arrived while the interrupt was off waits in the port and raised nothing.
        on_receive();
        Ok(count)
    }
}

impl Write for LinkUart {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, UartError> {
        for byte in bytes {
            if (0..TRANSMIT_POLLS).all(|_| UART0.state() & TRANSMIT_FULL != 0) {
                return Err(UartError::TransmitStuck);
            }
            UART0.send(*byte);
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<(), UartError> {
        Ok(())
    }
}

/// Starts the log's port alone, for an image without a link.
pub fn start_log() {
    UART1.baud_divider(BAUD_DIVIDER);
    UART1.control(TRANSMIT_ENABLE);
}

/// Sends the log's bytes. A port that stays full loses them: the log never holds up an estimate for long.
pub(crate) fn transmit_log(bytes: &[u8]) {
    for byte in bytes {
        if (0..LOG_POLLS).all(|_| UART1.state() & TRANSMIT_FULL != 0) {
            return;
        }
        UART1.send(*byte);
    }
}

/// As [`TRANSMIT_POLLS`], for the log.
const LOG_POLLS: u32 = 1_000_000;
