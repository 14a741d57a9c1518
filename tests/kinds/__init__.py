"""What every kind of joint, coupling and force must have."""
