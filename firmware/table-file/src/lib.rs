//! The file that carries a frozen network from the trainer to the flight image.
