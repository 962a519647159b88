"""The real-time part: reads devices, stamps, sounds, keeps the transport. Owns no window and renders nothing."""
