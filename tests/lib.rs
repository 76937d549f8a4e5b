//! Tests that span the firmware and the host tools; see the files beside this one.
