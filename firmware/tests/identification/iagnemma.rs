//! Iagnemma.
