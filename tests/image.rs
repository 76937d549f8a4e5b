//! The flight image in QEMU: the same bits as on the host, within its memory, and never a hang.

use std::time::{Duration, Instant};

use kapvik_firmware::wheel_state::WHEELS;
use kapvik_host::flight_computer::FlightComputer;
use kapvik_host::qemu::{Binary, Clock, Image, LogView, Machine, MemoryUse};
use kapvik_tests::{
    bits, budgets, estimates_of_the_recorded_drive, flight_computer, flight_image, queries, random, spoiled, toolchain,
};
use object::{Object, ObjectSymbol, SymbolKind};

#[test]
fn the_self_test_passes_before_the_first_estimate() {
    let mut computer = flight_computer();
    let report = computer.boot_report().expect("the image says hello");
    assert!(report.self_test.passed(), "{report:?}");
    assert_eq!(computer.self_test().expect("the image tests itself again"), report.self_test);
    let log = computer.into_log();
    assert!(log.iter().any(|line| line.level == "info" && line.text.contains("self-test passed")), "{log:?}");
}

#[test]
fn a_thousand_queries_give_the_bits_of_the_host() {
    let mut random = random(20);
    let mut asked = queries(1000, &mut random);
    for query in asked.iter_mut().step_by(7) {
        *query = spoiled(query.clone(), &mut random);
    }
    let mut host = FlightComputer::in_process().expect("the library answers in this process");
    let mut target = flight_computer();
    let start = Instant::now();
    let on_target = target.query_all(&asked).expect("the image answers");
    println!("{} queries in {:?}", asked.len(), start.elapsed());
    let on_host = host.query_all(&asked).expect("the library answers");
    for ((query, target), host) in asked.iter().zip(&on_target).zip(&on_host) {
        assert_eq!(bits(target), bits(host), "{query:?}: {target:?}, and {host:?} on the host");
        assert_eq!(target.wheels.len(), query.wheels.len());
    }
    let health = target.health().expect("the image is well");
    assert_eq!(health.queries_answered, 1000);
    assert_eq!((health.link.refused(), health.link.sequence_gaps, health.link.replies_lost), (0, 0, 0));
}

#[test]
fn one_query_at_a_time_gives_the_same_as_many() {
    let asked = queries(20, &mut random(21));
    let mut computer = flight_computer();
    let many = computer.query_all(&asked).expect("the image answers");
    for (query, expected) in asked.iter().zip(&many) {
        assert_eq!(bits(&computer.query(query).expect("the image answers")), bits(expected));
    }
}

#[test]
fn memory_is_within_its_budget() {
    let budget = budgets().image;
    let memory = MemoryUse::of(flight_image()).expect("the image has segments");
    let mut computer = flight_computer();
    let asked: Vec<_> =
        queries(200, &mut random(22)).into_iter().filter(|query| query.wheels.len() == WHEELS).collect();
    assert!(!asked.is_empty());
    computer.query_all(&asked).expect("the image answers");
    computer.self_test().expect("the image tests itself");
    estimates_of_the_recorded_drive(&mut computer);
    computer.send_bytes(&[0x55; 2000]).expect("the image listens");
    computer.send_bytes(&[0]).expect("the image listens");
    let stack = computer.health().expect("the image is well").stack_high_water_bytes.expect("the board measures it");
    println!("flash {} bytes, static RAM {}, stack {stack}", memory.flash_bytes, memory.static_ram_bytes);
    assert!(stack > 0 && memory.flash_bytes > 0);
    assert!(memory.flash_bytes <= budget.flash_bytes, "{memory:?}");
    assert!(memory.static_ram_bytes + stack <= budget.ram_bytes, "{memory:?}, stack {stack}");
}

/// The functions in an image that allocate or panic.
fn unwanted_functions(image: &Image) -> Vec<String> {
    const UNWANTED: [&str; 6] =
        ["__rust_alloc", "malloc", "panicking", "expect_failed", "unwrap_failed", "rust_begin_unwind"];
    let bytes = image.read().expect("the image can be read");
    let file = object::File::parse(bytes.as_slice()).expect("the image is an object file");
    let code = file.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text);
    let names = code.filter_map(|symbol| symbol.name().map(str::to_owned).ok());
    names.filter(|name| UNWANTED.iter().any(|part| name.contains(part))).collect()
}

#[test]
fn nothing_in_the_image_can_allocate_or_panic() {
    assert_eq!(unwanted_functions(flight_image()), Vec::<String>::new());
    let filter = Image::build(toolchain(), Binary::Filter).expect("the image with the filter builds");
    assert_eq!(unwanted_functions(&filter), Vec::<String>::new());
    // The search finds what it looks for.
    let panics = Image::build(toolchain(), Binary::Fault).expect("the image that panics builds");
    assert!(!unwanted_functions(&panics).is_empty());
}

#[test]
fn every_step_of_the_filter_ends_well_on_the_target() {
    let image = Image::build(toolchain(), Binary::Filter).expect("the image with the filter builds");
    let machine = Machine::start(toolchain(), &image, Clock::Wall, LogView::Nothing).expect("QEMU starts");
    assert_eq!(machine.wait(Duration::from_secs(60)).expect("it ends").code, Some(0));
}

#[test]
fn a_panic_ends_qemu_with_a_failure_and_names_its_place() {
    let image = Image::build(toolchain(), Binary::Fault).expect("the image that panics builds");
    let machine = Machine::start(toolchain(), &image, Clock::Wall, LogView::Nothing).expect("QEMU starts");
    let ended = machine.wait(Duration::from_secs(60)).expect("a panic ends QEMU");
    assert_eq!(ended.code, Some(101), "{ended:?}");
    let named = |text: &str| text.contains("panic at") && text.contains("fault_an386.rs");
    assert!(ended.log.iter().any(|line| line.level == "error" && named(&line.text)), "{ended:?}");
}

#[test]
fn an_image_that_does_not_end_is_an_error_with_its_last_words() {
    let machine = Machine::start(toolchain(), flight_image(), Clock::Wall, LogView::Nothing).expect("QEMU starts");
    let error = machine.wait(Duration::from_secs(2)).expect_err("the flight image runs until it is switched off");
    assert!(error.to_string().contains("still running"), "{error}");
    assert!(error.to_string().contains("self-test passed"), "{error}");
}

#[test]
fn no_qemu_is_left_behind() {
    let machine = Machine::start(toolchain(), flight_image(), Clock::Wall, LogView::Nothing).expect("QEMU starts");
    let process = std::path::PathBuf::from(format!("/proc/{}", machine.process_id()));
    assert!(process.exists());
    drop(machine);
    assert!(!process.exists());
}
